// What the fit of each joint of a robot gets: its columns over all logs, with the rigid part of a description that may be wrong.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/robot/robot_joint.h"
#include "sim/robot/regressor.h"
#include "tools/robot/robot_data.h"

namespace warmjoint {

/// What of gravity the torques of a log hold.
enum class GravityHeld { described, turned, taken_off };

/// Gravity along a log, m/s^2 in the world's axes of the description.
struct RobotGravity {
  Eigen::Vector3d described;  // by which the motions were made
  Eigen::Vector3d in_torque;  // that the torques hold
  Eigen::Vector3d at_joints;  // that loads them
  Eigen::MatrixXd open;       // [3 x k] by deviations of 1 of what is not known of both
};

/// Samples of all logs, and the motion behind them: what stays while fits ask for other columns.
struct RobotRows {
  std::vector<RobotSamples> samples;  // one for each log
  std::vector<RobotMotion> motions;
  RobotGravity gravity;
  Eigen::VectorXd parameters;  // [10 L] of the description, a given tool included
  /// [10 L x 10 L] what a deviation of 1 in each direction of the prior adds to the parameters, a block a link: all ten with its mass, then
  /// the place of the mass (3), inertia (6).
  Eigen::MatrixXd deviations;
};

RobotRows MakeRows(const RobotData& data, const RobotSettings& settings);

/// Every so manieth sample, at most some `most` of each log, without ripple: for fits without heat.
RobotRows Thinned(const RobotData& data, const RobotRows& rows, Eigen::Index most);

/// Torque of joint (motor) j for a gravity of 1 m/s^2 along each axis of the world, by the description. [N x 3], N.m or N
Eigen::MatrixXd GravityColumns(const RobotData& data, const RobotRows& rows, Eigen::Index j);

/// What the prior of a description is turned to: what the torque of the joint sees, or all directions, the same for all joints.
enum class Directions { seen, all };

/// Columns of joint (motor) j. The rows of several logs stand one behind the other.
JointColumns ColumnsOf(const RobotData& data, const RobotRows& rows, Eigen::Index j,
                       Directions directions = Directions::seen);

/// The link at the end: the last of those that most joints move.
Eigen::Index LastLink(const RobotDescription& robot);

}  // namespace warmjoint
