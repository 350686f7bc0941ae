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
  Selection selection;            // n of its samples are kept
};

/// By what the strength s of the prior is chosen.
enum class StrengthRule { cross_validation, leave_one_out, evidence };

struct ChosenStrength {
  double strength = 0;
  /// Mean squared error held out, or -2 log evidence / n: the smaller, the better. Infinite where
  /// no strength can be solved.
  double criterion = 0;
};

/// One of 20 strengths, half a decade apart, from 1e-7 of the mean diagonal of the kernels' Gram
/// matrix on: the best, or the one of the most evidence. Cross validation takes the strongest that
/// is as good as the best within one standard error of the parts' differences (Breiman and others
/// 1984, 3.4.3): a motion that repeats itself hides in every part what a weak prior does to columns
/// that kernels can imitate. folds: contiguous parts of the kept samples for cross validation.
/// Neighbours resemble each other, so that leaving out one sample or the evidence of white noise
/// take coloured noise for friction: cross validation over long parts does not.
ChosenStrength ChooseStrength(const MapProblem& problem, StrengthRule rule, int folds);

struct MapFit {
  Eigen::Index free = 0;          // p
  Eigen::VectorXd x;              // [p + q] parameters, weights
  double strength = 0;            // s
  double effective = 0;           // trace of the hat matrix
  Eigen::VectorXd fitted;         // [n] N.m or N
  Eigen::MatrixXd gram;           // [p + q]^2 A^T A
  Eigen::MatrixXd inverse;        // [p + q]^2 (A^T A + s P)^-1
  std::vector<FrictionMap> maps;  // with their weights
};

/// argmin |y - A x|^2 + s |w|^2. Nothing where the system is singular to rounding or overflows.
std::optional<MapFit> FitMaps(const MapProblem& problem, double strength);

/// The maps with their weights, one map's after the other's. weights: [q]
std::vector<FrictionMap> WithWeights(std::vector<FrictionMap> maps, const Eigen::VectorXd& weights);

/// How sure its parameters and weights are (penalised_uncertainty.h).
Uncertainty JudgeMaps(const MapProblem& problem, const MapFit& fit);

/// Free columns that the kernels can imitate, to a thousandth of their squares: the prior alone
/// tells these apart from a map.
std::vector<Eigen::Index> ImitatedColumns(const MapFit& fit);

/// Sum of maps at some points, [n] N.m or N.
Eigen::VectorXd EvaluateMaps(const std::vector<FrictionMap>& maps, const MapPoints& points);

}  // namespace warmjoint
