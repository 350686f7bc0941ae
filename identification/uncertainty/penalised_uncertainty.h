// How uncertain the parameters of a fit are that a prior holds.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "identification/uncertainty/uncertainty.h"

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

/// A fit x = argmin |y - f(x)|^2 + s |w|^2 + x^T P x, w those of a run of entries of x that data tell of, P = diag(prior).
struct PenalisedFit {
  const Eigen::MatrixXd& gram;     // [d x d] G = J^T J, without the prior
  const Eigen::MatrixXd& inverse;  // [d x d] C, the inverse of G and what is added
  Eigen::Index first;              // place of w in x
  Eigen::VectorXd weights;         // [q] w
  double strength;                 // s
  /// [q] weights that follow their neighbours and are not drawn from the prior
  const std::vector<bool>& unseen;
  /// [d] the noise's variance over what each parameter was known by beforehand, or 0; or empty
  Eigen::VectorXd prior{};
  CorrelationOver correlation{};  // of the weights that are not unseen
};

/// Covariance of the errors of x, from the noise and from the prior's pull,
///   C J^T R J C + s^2 C_w S C_w^T + s_e^2 C P C,
/// C_w the columns of the weights, S their covariance before any data (PriorOfWeights), R the covariance of the
/// noise by an autoregressive model of the residual, so that intervals are right for coloured noise too; for white
/// noise and S = s_e^2 / s this is the posterior s_e^2 C. Of the weights L = (C G)_ww is found, their pull takes
/// B = s^2 C_w^T G C_w from the fitted values, and V = (C J^T R J C)_ww is their noise.
/// rows(first, last): of J at the kept samples first <= i < last; residual: [n] y - f.
Uncertainty PenalisedCovariance(
    const PenalisedFit& fit,
    const std::function<Eigen::MatrixXd(Eigen::Index first, Eigen::Index last)>& rows,
    const Eigen::VectorXd& residual, const Selection& selection);

}  // namespace warmjoint
