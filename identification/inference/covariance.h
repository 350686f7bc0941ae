// The covariance of a fit's parameters.
#pragma once

#include "identification/fit.h"

namespace warmjoint::inline identification {

/// Covariance of x, as the fit's error model says, for noise of the colour and the unevenness that
/// the residual shows (uncertainty.h). [p x p] in the coordinates of the parameters.
Uncertainty CovarianceOf(const Fit& fit);

}  // namespace warmjoint::inline identification
