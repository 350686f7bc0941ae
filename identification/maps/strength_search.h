// The strengths of a prior that are worth a look.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/ridge/ridge.h"

namespace warmjoint {

/// Strengths s of a prior: 20, half a decade apart, from 1e-7 of the mean diagonal of the kernels' Gram matrix
/// on. free: leading columns without a prior.
std::vector<double> Strengths(const NormalEquations& normal, Eigen::Index free);

/// What cross validation says of one strength.
struct StrengthTrial {
  double strength = 0;
  bool possible = true;    // whether the fit to all rows leaves all parameters above their bounds
  Eigen::ArrayXd squares;  // [parts] held out, (N.m)^2 or N^2
};

/// Whether the errors are those of the best within one standard error of the parts' differences.
bool AsGood(const Eigen::ArrayXd& squares, const Eigen::ArrayXd& best);

/// Those strengths among which the choice falls, ascending: the one with the least error of those that are
/// possible, the stronger ones that are as good, and some others. The error has one valley over the
/// strengths, or several of which every fourth strength tells the deepest. Without those that are too small
/// to solve. parts: of the rows; lower: bounds of the free parameters, or empty: none.
std::vector<StrengthTrial> SearchStrengths(const std::vector<NormalEquations>& parts,
                                           const NormalEquations& all, Eigen::Index free,
                                           const std::vector<double>& lower);

}  // namespace warmjoint
