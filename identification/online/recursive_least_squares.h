// Recursive least squares with forgetting, one sample at a time.
#pragma once

#include <Eigen/Core>

namespace warmjoint {

/// What is known after some samples; d = D parameters, or any number for Eigen::Dynamic.
template <int D>
struct RecursiveState {
  Eigen::Matrix<double, D, 1> estimate;  // [d]
  Eigen::Matrix<double, D, D> cofactor;  // [d x d] (sum of f^age a a^T)^-1
};

/// Nothing known: estimate 0, cofactor `doubt` times the identity. doubt: large beside the inverse
/// of the regressor's squares.
template <int D>
RecursiveState<D> KnowNothing(Eigen::Index d, double doubt) {
  return {Eigen::Matrix<double, D, 1>::Zero(d),
          doubt * Eigen::Matrix<double, D, D>::Identity(d, d)};
}

/// The state after one more sample y = a . x + noise (Ljung, System Identification, 11.2):
///   g = P a / (f + a . P a),  x <- x + g (y - a . x),  P <- (P - g (P a)^T) / f.
/// forgetting: f, above 0 and at most 1; a sample counts f as much as its successor. P stays
/// symmetric to the last bit.
template <int D>
void TakeIn(const Eigen::Matrix<double, D, 1>& a, double y, double forgetting,
            RecursiveState<D>& state) {
  const Eigen::Matrix<double, D, 1> Pa = state.cofactor * a;
  const double scale = 1 / (forgetting + a.dot(Pa));
  const double innovation = y - a.dot(state.estimate);
  state.estimate += (scale * innovation) * Pa;
  const Eigen::Matrix<double, D, D> outer = Pa * Pa.transpose();
  state.cofactor = (state.cofactor - scale * outer) * (1 / forgetting);
}

}  // namespace warmjoint
