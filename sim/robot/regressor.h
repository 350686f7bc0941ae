// The rigid-body torque of a robot along a motion, linear in its inertial parameters.
#pragma once

#include <Eigen/Core>

#include "sim/robot/description.h"

namespace warmjoint {

/// Whether accelerations count, or the torque is that of gravity and Coriolis forces alone.
enum class Accelerations { counted, left_out };

/// What of each sample the torque of every joint follows from: for each link the twist of its axes and the acceleration that a
/// body there would feel, for each joint its axis in those of each link. One pass of MuJoCo's kinematics and recursive Newton-Euler
/// (mj_rnePostConstraint) a sample, no unit vectors.
class RobotMotion {
 public:
  /// q, v, a: [N x n] of the robot's joints, rad or m, and by s and s^2.
  RobotMotion(const RobotDescription& robot, const Eigen::MatrixXd& q, const Eigen::MatrixXd& v,
              const Eigen::MatrixXd& a);

  Eigen::Index size() const { return samples_; }

  /// Y: torque = Y phi, phi the parameters of all links (RobotDescription::Parameters). Of the sum of all joints' torques
  /// times `weights` [n], as a motor has it that drives several. Equal to mj_inverse of a model in which nothing else acts.
  /// Returns [N x 10 L], N.m or N for each unit of phi.
  Eigen::MatrixXd Regressor(const Eigen::VectorXd& weights, Accelerations which) const;
  /// What a gravity by itself adds to it, at rest. gravity: m/s^2, in the world's axes. [N x 10 L]
  Eigen::MatrixXd GravityRegressor(const Eigen::VectorXd& weights,
                                   const Eigen::Vector3d& gravity) const;
  /// The same of one joint.
  Eigen::MatrixXd Regressor(Eigen::Index joint, Accelerations which) const;

 private:
  /// Numbers of a link in a row: rotation of its axes (9), its place from the centre of its tree (3), angular velocity (3), angular
  /// acceleration and acceleration of the origin less gravity, with qacc (6) and without (6).
  static constexpr Eigen::Index kOfLink = 27;

  void Record(const mjModel& m, const mjData& d, Eigen::Index sample, Accelerations which);
  template <typename Row>
  Eigen::MatrixXd RowsOf(const Eigen::VectorXd& weights, const Row& row) const;

  RobotDescription robot_;
  Eigen::Index samples_ = 0;
  Eigen::MatrixXd links_;   // [kOfLink L x N]
  Eigen::MatrixXd joints_;  // [6 n x N] cdof
};

/// Directions in which a description may be wrong and a torque shows it: phi = phi0 + B z, z ~ N(0, 1).
struct PriorDirections {
  Eigen::MatrixXd basis;  // [10 L x r] B
};

/// deviations: [10 L] standard deviations of phi; regressor: [N x 10 L] of a torque. Those that it does not see, by less than 1e-9 of
/// the squares of the one that it sees best, are left out.
PriorDirections DirectionsSeen(const Eigen::MatrixXd& regressor, const Eigen::VectorXd& deviations);

}  // namespace warmjoint
