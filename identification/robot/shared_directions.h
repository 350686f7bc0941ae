// The errors of a robot's description, estimated from all of its joints together.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/robot/robot_joint.h"

namespace warmjoint {

/// The directions z of a description, seen by all joints at once.
struct SharedDirections {
  Eigen::VectorXd z;              // [r]
  Eigen::MatrixXd covariance;     // [r x r]
  double degrees_of_freedom = 1;  // of Student's quantile: the fewest of a joint
  bool converged = false;
};

/// The least squares (minimise.h) over the joints' own unknowns and one z for all of them, from the joints' fits on. fits, columns:
/// [n] of joints whose columns have the same r directions. Weights, priors and the colour of the noise are those of each
/// joint's fit; the prior of z counts once. Where the unit does not tell the gains, their prior is about the mean of
/// the joints' log gains, so that it does not determine a common scale of all masses.
SharedDirections FitShared(const std::vector<JointFit>& fits,
                           const std::vector<JointColumns>& columns);

}  // namespace warmjoint
