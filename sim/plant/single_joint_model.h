// A robot with one joint free and friction on it.
#pragma once

#include <warmjoint/friction.h>

#include <string>
#include <utility>

#include "sim/model/mujoco_handles.h"

namespace warmjoint::inline sim {

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

}  // namespace warmjoint::inline sim
