// What the joints of a robot say together of where their description is wrong.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/robot/robot_joint.h"

namespace warmjoint {

/// The directions z of a description, seen by all joints at once.
struct SharedDirections {
  Eigen::VectorXd z;              // [r]
  Eigen::MatrixXd covariance;     // [r x r]
  double degrees_of_freedom = 1;  // of Student's quantile: that of the joint with the fewest blocks
  bool converged = false;
};

/// Gauss-Newton over the joints' own unknowns and one z for all of them, from the joints' fits on. fits, columns: [n] of joints whose columns have the
/// same r directions. The own unknowns of each joint are eliminated (Schur complement), so that a step solves r equations. Weights, priors and the sandwich
/// by blocks of time are those of each joint's fit (CovarianceOf); the prior of z counts once. The prior of a gain is about the mean of
/// the joints' log gains, so that the gains alone do not scale what all masses together may be.
SharedDirections FitShared(const std::vector<JointFit>& fits,
                           const std::vector<JointColumns>& columns);

}  // namespace warmjoint
