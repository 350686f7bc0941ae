// What of a robot's measured torques is neither rigid-body torque nor friction: what acts on it from outside.
#pragma once

#include <warmjoint/identify_robot.h>

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "models/friction/compensator.h"
#include "models/recording/assemble.h"
#include "tools/robot/robot_data.h"

namespace warmjoint {

/// One joint along a log of N samples, filtered; torques in N.m or N. All [N].
struct JointExternal {
  std::string joint;
  JointKind kind = JointKind::rotary;
  Eigen::VectorXd velocity;    // rad/s or m/s
  Eigen::VectorXd torque;      // measured
  Eigen::VectorXd rigid;       // weight, inertia and rotor
  Eigen::VectorXd friction;    // 0 at rest
  Eigen::VectorXd energy;      // E
  Eigen::VectorXd external;    // on the joint: rigid + friction - torque
  Eigen::VectorXd half_width;  // of its 95 % band; at rest friction is anywhere within its level
  Eigen::VectorXd contact;     // 1 where it is more than friction explains
};

/// A robot along a log.
struct RobotExternal {
  Eigen::VectorXd time;               // [N] s
  std::vector<JointExternal> joints;  // of those whose friction is known
  Eigen::MatrixXd
      force;  // [N x 3] at the tool, N, in the axes of the world; NaN where the joints do not tell it
  Eigen::MatrixXd force_half_width;  // [N x 3] N
  std::vector<std::string> notices;  // one sentence each
};

/// Of a log of the robot that was identified. settings: as of its identification; compensation: of each joint. The rigid torque is that of the
/// description as the joint's own fit mended it. The force is the least that explains the torques, by weights of their variances:
///   f = (J W J^T)^-1 J W tau,   cov f = (J W J^T)^-1,   J: [3 x n] of the origin of the last link, or tool.centre in its axes.
/// Throws BadInput, also where no joint has a friction in N.m or N.
RobotExternal FindExternal(const std::filesystem::path& robot, const RobotEstimate& estimate,
                           const RobotSource& source, RobotSettings settings,
                           const CompensatorSettings& compensation);

/// time; JOINT.velocity, .torque, .rigid, .friction, .energy, .external, .half_width and .contact of each joint; force.x, .y, .z
/// and force_half_width.x, .y, .z.
FileContent ColumnsOf(const RobotExternal& found);

}  // namespace warmjoint
