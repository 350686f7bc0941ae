// How uncertain a fit to few segments of constant speed is.
#pragma once

#include <Eigen/Core>

#include "identification/uncertainty/uncertainty.h"

namespace warmjoint {

/// Whether the kept samples stand in so few segments that how friction differs from one to the next
/// cannot be seen beside p parameters: fewer than 8 segments beyond them, what the tests for lack of
/// fit need as well. Samples that belong to no segment, or a selection that knows none, say nothing.
bool HasFewSegments(const Selection& selection, Eigen::Index p);

/// Degrees of freedom that so few segments leave p parameters at least, 1 or more; infinite where
/// they are not few.
double FewestFreedom(const Selection& selection, Eigen::Index p);

/// Replaces covariance and degrees of freedom by those of errors that have anything in common within a segment
/// and nothing from one to the next:
///
///     C (sum over segments g of s_g s_g^T) C,   s_g = X_g^T (I - X_g C X_g^T)^(-1/2) r_g,
///
/// which is right on average for white noise whatever the number of segments (CR2; Bell and McCaffrey
/// 2002, Imbens and Kolesar 2016). Degrees of freedom, for each parameter, are those with which
/// Student's quantile holds 95 % of white noise's errors: the variance is a sum of chi^2 with known
/// weights, from whose mean and variance alone those authors take them. They are 1 at least, and 1
/// with the deviation as it was where the segments are no more than the parameters, and their scatter
/// tells nothing. Linear in the number of samples.
/// X: [n x p] rows of the fit at the kept samples, whitened where they were; cofactor: C; residual:
/// [n]; uncertainty: of the same fit.
void CountSegments(const Eigen::MatrixXd& X, const Eigen::MatrixXd& cofactor,
                   const Eigen::VectorXd& residual, const Selection& selection,
                   Uncertainty& uncertainty);

}  // namespace warmjoint
