// Which gravity a robot's torques hold: that of the description, one of another direction, or none.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tools/robot/joint_data.h"
#include "tools/robot/robot_data.h"

namespace warmjoint {

/// What the log's torques say of gravity.
struct GravityFound {
  GravityHeld held = GravityHeld::described;
  Eigen::Vector3d vector =
      Eigen::Vector3d::Zero();  // m/s^2, in the world's axes of the description
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // of it, where that was found
  double falls = 0;  // sum over the joints of the logarithms by which their residuals fall
};

/// Two directions across a unit vector and each other.
Eigen::Matrix<double, 3, 2> Across(const Eigen::Vector3d& u);

/// Y phi is linear in gravity. Each joint's torque is the least squares of friction, rotor, rigid torque without gravity, and s_j times the torque
/// of a gravity of the direction u, s_j >= 0. Over all joints, u makes the sum of the logarithms of their residuals least. It is
/// `turned` where the residuals of two joints fall by a factor of 2 at least, against the description's direction; `taken_off` where gravity would
/// stand out of the residual of two joints, had the torque it, and no joint shows its share. joints: those that move.
GravityFound FindGravity(const RobotData& data, const RobotRows& rows,
                         const std::vector<Eigen::Index>& joints);

/// What is said of it. described: gravity of the description, m/s^2
std::string ExplainGravity(const GravityFound& found, const Eigen::Vector3d& described);

}  // namespace warmjoint
