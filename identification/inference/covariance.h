// The covariance of a fit's parameters.
#pragma once

#include "identification/fit.h"

namespace warmjoint {

/// Covariance of x, as the fit's error model says, for noise of the colour and the unevenness that
/// the residual shows (uncertainty.h). [p x p] in the coordinates of the parameters.
Uncertainty CovarianceOf(const Fit& fit);

/// Degrees of freedom of the noise's variance that n weighted samples leave beside d parameters: at
/// least 1. (sum w)^2 / sum w^2 of them count. weights: [n].
double DegreesOfFreedomOfWeights(const Eigen::VectorXd& weights, const NoiseModel& noise,
                                 Eigen::Index d);

}  // namespace warmjoint
