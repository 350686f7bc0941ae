// What is known of a LuGre fit: how its samples weigh, and how sure its parameters are.
#pragma once

#include <vector>

#include "identification/identifier.h"
#include "identification/nonlinear/lugre_fit.h"
#include "identification/uncertainty/uncertainty.h"

namespace warmjoint {

/// A fit with what is known of it.
struct LugreAnswer {
  LugreFit fit;
  Uncertainty known;               // of the parameters that are not constant
  std::vector<Eigen::Index> rows;  // [l + 4] of each parameter in `known`, or -1

  double Deviation(Eigen::Index i) const {
    const Eigen::Index row = rows[static_cast<size_t>(i)];
    return row < 0 ? 0 : known.Deviation(row);
  }
};

/// Standard deviation of the residual of the kept samples and of the others, N.m or N.
struct NoiseOfGroups {
  double kept = 0;
  double others = 0;
};

/// Weighs both groups of samples by what a fit leaves of them, and outliers as Huber (1964) does:
/// where the drive's torque jumps, the acceleration between samples is not known.
NoiseOfGroups WeighLugre(const Selection& selection, const LugreFit& fit, LugreProblem& problem);

/// Covariance of the parameters that are not constant: noise and, as if it were one standard
/// deviation, what the sampling shifts them by.
LugreAnswer JudgeLugre(const IdentifierInput& input, const LugreProblem& problem, LugreFit fit);

}  // namespace warmjoint
