// How uncertain the parameters of a fit are that a prior holds.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "identification/uncertainty/uncertainty.h"

namespace warmjoint {

/// [q x q] correlation R of weights that go together over `length` kernels; the identity for 0.
using CorrelationOver = std::function<Eigen::MatrixXd(double length)>;

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
/// rows: of J; residual: [n] y - f.
Uncertainty PenalisedCovariance(const PenalisedFit& fit, const RowsBetween& rows,
                                const Eigen::VectorXd& residual, const Selection& selection);

}  // namespace warmjoint
