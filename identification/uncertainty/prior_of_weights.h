// From which prior the weights of kernels seem to be drawn, told by those that were found.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace warmjoint {

/// Weights that a prior pulls towards 0, w_found = L w + noise.
struct PulledWeights {
  const Eigen::VectorXd& found;  // [q]
  const Eigen::MatrixXd& left;   // [q x q] L, what the prior leaves of w
  const Eigen::MatrixXd&
      bias;  // [q x q] B: w^T B w is what the pull takes from the fitted values, squared
  const Eigen::MatrixXd& noise;  // [q x q] V, covariance of w_found by noise
};

/// [q x q] correlation R of weights that go together over `length` kernels; the identity for 0.
using CorrelationOver = std::function<Eigen::MatrixXd(double length)>;

/// Covariance s_w^2 R of the weights before any data. [q x q]
///
/// s_w^2 counts each direction of the weights as much as its pull moves the fitted values, since the directions that
/// the data know well say nothing of how large those are that the prior holds back:
///     E w_found^T B w_found = s_w^2 tr (L^T B L R) + tr (B V).
/// Its scatter by noise, the square root of 2 tr (B V B V), joins in squares, so that a map that cannot be seen is not
/// reported as surely 0.
///
/// R is the identity, or the longest of those over 1/2, 1, 2 and 4 kernels up to which the weights become more likely,
///     w_found ~ N(0, s_w^2 L R L^T + V),
/// and the pull takes less from the fitted values, tr (B S); where it is more likely than independent weights at 1 %.
/// A map that is smooth from kernel to kernel loses less to the prior than one that is not. Empty or null `correlation`: the identity.
Eigen::MatrixXd PriorOfWeights(const PulledWeights& weights, const CorrelationOver& correlation);

}  // namespace warmjoint
