// Law and maps fitted together: how strong the prior is, the fit, and how sure it is.
#pragma once

#include <optional>
#include <string>

#include "identification/local_rows.h"
#include "identification/uncertainty.h"

namespace warmjoint {

/// A law that is linear in its parameters, and kernels with a Gaussian prior N(0, s_w^2) on their
/// weights alone, on the n samples that a selection keeps:
///   y = free p + sum_i w_i kappa_i + e.
struct MapProblem {
  std::vector<FrictionMap> maps;  // shapes; their weights are not read
  MapPoints points;               // [n x 5]
  Eigen::MatrixXd free;           // [n x p]
  Eigen::VectorXd torque;         // [n] y, N.m or N
  const Selection& selection;     // n of its samples are kept
};

/// By what the strength s of the prior is chosen.
enum class StrengthRule { cross_validation, leave_one_out, evidence };

struct ChosenStrength {
  double strength = 0;
  /// Mean squared error held out, or -2 log evidence / n: the smaller, the better. Infinite where
  /// no strength can be solved.
  double criterion = 0;
};

/// The best of 20 strengths, half a decade apart, from 1e-7 of the mean diagonal of the kernels'
/// Gram matrix on, or the one of the most evidence. folds: contiguous parts of the kept samples for
/// cross validation. Neighbours resemble each other, so that leaving out one sample or the evidence
/// of white noise take coloured noise for friction: cross validation over long parts does not.
ChosenStrength ChooseStrength(const MapProblem& problem, StrengthRule rule, int folds);

struct MapFit {
  Eigen::Index free = 0;           // p
  Eigen::VectorXd x;               // [p + q] parameters, weights
  double strength = 0;             // s
  double effective = 0;            // trace of the hat matrix
  Eigen::VectorXd fitted;          // [n] N.m or N
  Uncertainty known;               // covariance [p + q]^2 of the errors x - truth
  std::vector<Eigen::Index> soft;  // free columns that kernels can imitate: the prior decides
  /// The maps with their weights.
  std::vector<FrictionMap> maps;
};

/// argmin |y - A x|^2 + s |w|^2. Its errors come from the noise and from the prior's pull,
///   cov = C A^T R A C + s^2 s_w^2 C P C,  C = (A^T A + s P)^-1, P = diag(0, I),
/// R the covariance of the noise by an autoregressive model of the residual, so that intervals are
/// right for coloured noise too; for white noise and s = s_e^2 / s_w^2 this is the posterior
/// s_e^2 C. s_w^2 comes from the weights themselves: E|w|^2 = s_w^2 tr(I - s C_ww)^2 +
/// tr(C A^T R A C)_ww; where that leaves less than its own scatter, the scatter is taken, so that a
/// map that cannot be seen is not reported as surely 0.
/// Nothing where the system is singular to rounding or overflows.
std::optional<MapFit> FitMaps(const MapProblem& problem, double strength);

}  // namespace warmjoint
