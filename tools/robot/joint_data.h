// What the fit of each joint of a robot gets: its columns over all logs, with the rigid part of a description that may be wrong.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/robot/robot_joint.h"
#include "sim/robot/regressor.h"
#include "tools/robot/robot_data.h"

namespace warmjoint {

/// Samples of all logs, and the motion behind them: what stays while fits ask for other columns.
struct RobotRows {
  std::vector<RobotSamples> samples;  // one for each log
  std::vector<RobotMotion> motions;
  Eigen::VectorXd parameters;  // [10 L] of the description, a given tool included
  /// [10 L x 10 L] what a deviation of 1 in each direction of the prior adds to the parameters, a block a link: all ten with its mass, then
  /// the place of the mass (3), inertia (6).
  Eigen::MatrixXd deviations;
};

RobotRows MakeRows(const RobotData& data, const RobotSettings& settings);

/// What the prior of a description is turned to: what the torque of the joint sees, or all directions, the same for all joints.
enum class Directions { seen, all };

/// Columns of joint (motor) j. The rows of several logs stand one behind the other.
JointColumns ColumnsOf(const RobotData& data, const RobotRows& rows, Eigen::Index j,
                       Directions directions = Directions::seen);

/// The link at the end: the last of those that most joints move.
Eigen::Index LastLink(const RobotDescription& robot);

}  // namespace warmjoint
