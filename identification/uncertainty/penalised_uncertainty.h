// How uncertain the parameters of a fit are that a prior holds.
#pragma once

#include <functional>

#include "identification/uncertainty/uncertainty.h"

namespace warmjoint::inline identification {

/// A fit x = argmin |y - f(x)|^2 + s |w|^2 + x^T P x, w a run of entries of x, P = diag(prior).
struct PenalisedFit {
  const Eigen::MatrixXd& gram;     // [d x d] G = J^T J, without the prior
  const Eigen::MatrixXd& inverse;  // [d x d] C, the inverse of G and what is added
  Eigen::Index first;              // place of w in x
  Eigen::VectorXd weights;         // [q] w
  double strength;                 // s
  /// [d] the noise's variance over what each parameter was known by beforehand, or 0; or empty
  Eigen::VectorXd prior{};
};

/// Covariance of the errors of x, from the noise and from the prior's pull,
///   C J^T R J C + s^2 s_w^2 C_w C_w^T + s_e^2 C P C,
/// C_w the columns of the weights, R the covariance of the noise by an autoregressive model of the residual, so that intervals are
/// right for coloured noise too; for white noise and s = s_e^2 / s_w^2 this is the posterior
/// s_e^2 C. s_w^2 comes from the weights themselves: E|w|^2 = s_w^2 tr (I - s C_ww)^2 +
/// tr (C J^T R J C)_ww; where that leaves less than its own scatter, the scatter is taken, so that
/// a map that cannot be seen is not reported as surely 0.
/// rows(first, last): of J at the kept samples first <= i < last; residual: [n] y - f.
Uncertainty JudgePenalised(
    const PenalisedFit& fit,
    const std::function<Eigen::MatrixXd(Eigen::Index first, Eigen::Index last)>& rows,
    const Eigen::VectorXd& residual, const Selection& selection);

}  // namespace warmjoint::inline identification
