// What becomes of intervals where the residual is structure.
#pragma once

#include "identification/fit.h"
#include "identification/uncertainty/disagreement.h"

namespace warmjoint {

/// The difference d of the whitened fit from the plain one tells how far structure in the residual moves
/// the parameters, about. Where J d stays below a tenth of the friction, as `--relevance` has it by
/// default, d joins the errors as one more of them, covariance + d d^T, and a warning says so; beyond
/// it no number gets an interval. friction: [n] F at the kept samples, N.m or N; fit: with its table, Jacobian and errors.
void AddStructure(const Disagreement& structure, const Eigen::VectorXd& friction, Fit& fit);

}  // namespace warmjoint
