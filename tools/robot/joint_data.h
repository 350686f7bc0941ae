// What the fit of each joint of a robot gets: its columns over all logs, with the rigid part of a description that may be wrong.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/model/robot_joint.h"
#include "sim/robot/regressor.h"
#include "tools/robot/robot_data.h"

namespace warmjoint {

/// Samples of all logs, and the motion behind them: what stays while fits ask for other columns.
struct RobotRows {
  std::vector<RobotSamples> samples;  // one for each log
  std::vector<RobotMotion> motions;
  Eigen::VectorXd parameters;  // [10 L] of the description, a given tool included
  Eigen::VectorXd deviations;  // [10 L] of its prior
};

RobotRows MakeRows(const RobotData& data, const RobotSettings& settings);

/// What the prior of a description is turned to: what the torque of the joint sees, or a direction for each parameter, the same for all joints.
enum class Directions { seen, parameters };

/// Columns of joint (motor) j. The rows of several logs stand one behind the other.
JointColumns ColumnsOf(const RobotData& data, const RobotRows& rows, Eigen::Index j,
                       Directions directions = Directions::seen);

/// The link at the end: the last of those that most joints move.
Eigen::Index LastLink(const RobotDescription& robot);

}  // namespace warmjoint
