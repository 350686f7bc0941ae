// Unknowns that all joints of a robot have in common: a delay of their torques, a turn of gravity.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace warmjoint {

struct GainGuess;
struct JointColumns;

/// k unknowns of all joints together.
struct CommonFit {
  Eigen::VectorXd value;       // [k]
  Eigen::MatrixXd covariance;  // [k x k]
  bool is_shown = false;       // beyond chance (1 %)
  double left = 0;  // sum over the joints of the logarithms of their residuals without it
  std::vector<Eigen::MatrixXd>
      columns;  // [n] of [N x k] what 1 more of each adds to a joint's torque
};

/// The columns of the unknowns in one joint's torque. fitted: [N] what its least squares give; returns [N x k]
using CommonColumns =
    std::function<Eigen::MatrixXd(std::size_t joint, const Eigen::VectorXd& fitted)>;

/// Each joint's least squares (rigid torque with the description's errors as wide as their prior, friction, rotor) with these columns further; the value is the mean over the
/// joints, weighed by their information. Its error is by blocks of 5 s, or by the joints' scatter where that is larger. joints, guesses: [n] of those that move
CommonFit FitCommon(const std::vector<const JointColumns*>& joints,
                    const std::vector<GainGuess>& guesses, double middle_gain,
                    const CommonColumns& columns);

/// A delay d of all torques against the positions, s; below 0 the positions are late. tau(t - d) = tau(t) - d dtau/dt.
CommonFit FitDelay(const std::vector<const JointColumns*>& joints,
                   const std::vector<GainGuess>& guesses, double middle_gain);

}  // namespace warmjoint
