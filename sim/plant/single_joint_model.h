// A robot with one joint free and friction on it, and whether that has room for a motion.
#pragma once

#include <warmjoint/friction.h>

#include <string>
#include <utility>
#include <vector>

#include "scenarios/motion.h"
#include "scenarios/scenario.h"
#include "sim/model/spec_elements.h"

namespace warmjoint {

/// A compiled model in which one joint moves, and where its numbers stand.
struct SingleJointModel {
  ModelPtr model;
  JointKind kind = JointKind::rotary;
  std::pair<double, double> limits;  // rad or m; infinite where the joint has none
  double inertia = 0;                // effective, kg.m^2 or kg
  double gravity_slope = 0;          // steepest, of gravity over the position, N.m/rad or N/m
  int friction_actuator = 0;         // its output in actuator_force
  int friction_state = 0;            // its first entry in act (StateOf)
  int friction_control = 0;          // the ambient temperature's rise in ctrl, K
  int friction_report = 0;           // in plugin_state: whether friction would have pushed
};

/// Loads an MJCF or URDF file, holds every joint but `joint` at its reference position, removes
/// what else would act (actuators, sensors, contacts, tendons, limits, damping and friction of the
/// joint's own), and adds the plugin with `friction`. asked_by: scenario, for messages.
/// Throws BadInput for a file that does not load, a joint that the robot lacks (with the nearest
/// name) or that is neither hinge nor slide, and what the plugin refuses.
SingleJointModel LoadSingleJoint(const std::string& path, const std::string& joint,
                                 const Friction& friction, double timestep,
                                 const std::string& asked_by);

/// Where a motion may go.
struct JointRoom {
  const Scenario& scenario;          // whose joint it is, and how long it moves
  std::pair<double, double> limits;  // rad or m; infinite where the joint has none
};

/// Throws BadInput where a motion from a position, rad or m, leaves the joint's limits: the first is
/// made of pieces at constant speed, the second of a velocity that is linear between corners.
void CheckReach(const JointRoom& room, const std::vector<MotionSegment>& plan, double position);
void CheckReach(const JointRoom& room, const std::vector<VelocityCorner>& corners, double position);

}  // namespace warmjoint
