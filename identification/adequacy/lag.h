// Torque that follows the velocity late.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "identification/adequacy/fitted_model.h"
#include "identification/adequacy/structure.h"
#include "models/recording/measurements.h"

namespace warmjoint::inline identification {

/// Looks for torque that lags: after a change of speed from friction F0 to F1 a share of F0 - F1
/// that is left in the first, second, third and fourth, fifth to eighth, and ninth to sixteenth
/// sample. A torque that is late by d samples leaves all of it in d samples; a filter of time
/// constant T leaves shares that sum to T over the sampling interval: the lag is their sum.
/// A lag leaves most in the first, a twentieth at least; what else depends on time does not.
/// Tested beside the fit (growing_fit.h) on the kept samples that follow a change.
/// residual: [N] tau - F; what is found is taken off it.
std::optional<Structure> FindLag(const FittedModel& model, const Measurements& measurements,
                                 Eigen::VectorXd& residual);

}  // namespace warmjoint::inline identification
