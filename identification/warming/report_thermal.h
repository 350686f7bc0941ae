// The thermal parameters of an estimate, continuous and discrete.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "identification/estimate.h"
#include "models/friction/thermal.h"
#include "models/recording/measurements.h"

namespace warmjoint::inline identification {

/// Appends thermal_gain (k), thermal_time_constant (tau), thermal_gain_discrete (ke) and
/// thermal_pole (te), the last two by Eq. (22) for the recording's mean step. covariance: [2 x 2]
/// of (k, ln tau), where known; standard deviations of the others follow to first order.
/// The intervals of tau and te are those of ln tau, so that tau stays positive.
/// freedom: samples less parameters.
void ReportThermal(const Thermal& thermal, const std::optional<Eigen::Matrix2d>& covariance,
                   double freedom, const Measurements& measurements, Estimate& estimate);

}  // namespace warmjoint::inline identification
