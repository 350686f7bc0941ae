// The family of robots: what is known of each folder of models/robots; URDF files, read by urdfdom.
#pragma once

#include <urdf_model/model.h>
#include <urdf_world/types.h>
#include <warmjoint/friction.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace warmjoint {

/// One movable joint, as the robot's URDF gives it.
struct RobotJoint {
  std::string name;  // the same in MJCF and URDF
  JointKind kind = JointKind::rotary;
  std::pair<double, double> limits;  // lower, upper, rad or m; infinite where there are none
  double effort = 0;                 // largest force of the motor at the joint, N.m or N
  double speed = 0;                  // largest, rad/s or m/s
};

/// A robot of the project: NAME/{NAME.xml, NAME.urdf, friction.json, README.md}.
struct RobotInfo {
  std::string name;
  std::string description;  // the heading of its README.md
  std::filesystem::path mjcf;
  std::filesystem::path urdf;
  std::vector<RobotJoint> joints;  // from the base outwards
  std::string friction_joint;      // whose friction friction.json holds
  Friction friction;
};

/// All robots, sorted by name, read from their folders: a new robot is its folder alone.
/// Throws BadInput that names the file that is missing or wrong.
std::vector<RobotInfo> Robots();

/// The robot that a URDF file describes. Throws BadInput with the file's name and what urdfdom
/// refuses.
urdf::ModelInterfaceSharedPtr ReadUrdf(const std::filesystem::path& path);

}  // namespace warmjoint
