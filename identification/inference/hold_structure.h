// What becomes of intervals where the residual is structure.
#pragma once

#include <Eigen/Core>

#include "identification/fit.h"
#include "identification/uncertainty/disagreement.h"

namespace warmjoint::inline identification {

/// The difference d of the whitened fit from the plain one tells how far structure in the residual moves
/// the parameters, about. Where J d stays below 2 % of the friction, as `--relevance` has it by
/// default, d joins the errors as one more of them, covariance + d d^T, and a warning says so; beyond
/// it no number gets an interval. friction: [n] F at the kept samples, N.m or N; fit: with all that its
/// covariance needs.
void HoldStructure(const Disagreement& structure, const Eigen::VectorXd& friction, Fit& fit);

}  // namespace warmjoint::inline identification
