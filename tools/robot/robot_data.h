// What identify-robot reads: a description, and the logs of its joints.
#pragma once

#include <warmjoint/identify_robot.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identification/robot/robot_samples.h"
#include "models/robot_log/robot_log.h"
#include "sim/robot/description.h"

namespace warmjoint {

/// Logs, each a file or columns in memory, and how they are read.
struct RobotSource {
  std::vector<RobotLogSource> logs;
  ReadSettings read;
};

struct RobotData {
  RobotDescription robot;
  std::vector<RobotLog> logs;             // one for each file
  std::vector<std::string> torque_units;  // [n] of the joints
  Eigen::MatrixXd coupling;               // [n x n] the motors turn by C q
  std::vector<std::string> notices;
};

/// Reads both. Positions that no joint could reach in rad and all could in degrees are taken for those, and currents are told by the names of their
/// columns; notices say so. Throws BadInput.
RobotData ReadRobotData(const std::filesystem::path& robot, const RobotSource& source,
                        const RobotSettings& settings);

/// [n x n] of "J6=J5+J6" and the like; "0.5*J5" and minus signs count. Throws BadInput for other texts.
Eigen::MatrixXd ReadCoupling(const std::vector<std::string>& texts,
                             const std::vector<ModelJoint>& joints);

}  // namespace warmjoint
