// How uncertain a fit to few segments of constant speed is.
#pragma once

#include <Eigen/Core>

#include "identification/uncertainty/uncertainty.h"

namespace warmjoint {

/// Whether the kept samples are in so few segments that how friction differs from one to the next
/// cannot be seen next to p parameters: fewer than p + 8 segments, which the tests for lack of
/// fit need as well. False where samples belong to no segment, or where the selection has no segments.
bool HasFewSegments(const Selection& selection, Eigen::Index p);

/// The least degrees of freedom that so few segments leave for p parameters, 1 or more; infinite where
/// the segments are not few.
double FewestFreedom(const Selection& selection, Eigen::Index p);

/// Replaces covariance and degrees of freedom by those of errors with any correlation within a segment
/// and none from one segment to the next:
///
///     C (sum over segments g of s_g s_g^T) C,   s_g = X_g^T (I - X_g C X_g^T)^(-1/2) r_g,
///
/// which is right on average for white noise whatever the number of segments (CR2; Bell and McCaffrey
/// 2002, Imbens and Kolesar 2016). Degrees of freedom, for each parameter, are those with which
/// Student's quantile holds 95 % of white noise's errors: the variance is a sum of chi^2 with known
/// weights, from whose mean and variance alone those authors take them. They are 1 at least, and 1
/// with the deviation as it was where the segments are no more than the parameters, so that their scatter
/// shows nothing. The time is linear in the number of samples.
/// X: [n x p] rows of the fit at the kept samples, whitened where they were; cofactor: C; residual:
/// [n]; uncertainty: of the same fit.
void CountSegments(const Eigen::MatrixXd& X, const Eigen::MatrixXd& cofactor,
                   const Eigen::VectorXd& residual, const Selection& selection,
                   Uncertainty& uncertainty);

}  // namespace warmjoint
