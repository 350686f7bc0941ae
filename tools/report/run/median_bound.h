// The median error at the Cramer-Rao bound, to compare medians with.
#pragma once

#include <Eigen/Core>

namespace warmjoint::report {

/// Median of |x| of a normal x with covariance C [d x d], by 20001 draws that are always the same: known
/// to 1 %. Where C is the bound of relative errors, the median NPE of an estimator that stands at it.
double MedianNormOf(const Eigen::MatrixXd& covariance);

}  // namespace warmjoint::report
