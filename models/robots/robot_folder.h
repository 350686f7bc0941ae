// The robots of the project and what is known of each; URDF files, read by urdfdom.
#pragma once

#include <urdf_model/model.h>
#include <urdf_world/types.h>
#include <warmjoint/friction.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "models/foundation/data_folder.h"

namespace warmjoint {

/// Names of the robots of the project, sorted: each is a folder of models/robots.
std::vector<std::string> RobotNames();

/// The model file of a robot: of the project's by its name, else the path itself.
/// Throws BadInput, from the given place, with the nearest name.
std::filesystem::path FindRobot(const std::string& name_or_path, const std::string& asked_by);

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
