// Torque that follows the velocity late.
#pragma once

#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <optional>

#include "identification/lack_of_fit/fitted_model.h"
#include "identification/lack_of_fit/significance.h"

namespace warmjoint {

/// Looks for torque that lags: after a change from friction F0 to F1 a share c of
/// (F0 - F1) exp(-t/T) is left, t: time since the segment of constant speed began, whatever ramp
/// led to it. T is the best of 14 from an eighth of a sampling interval to half a hold. Samples of a segment are
/// taken together in runs that grow by half, so that short lags and long ones cost the same.
/// A torque that is late by d samples leaves all of F0 - F1 in d samples. The finding's lag is the
/// area under what is left over F0 - F1, s: T for a first-order filter.
/// residual: [N] tau - F; what is found is taken off it.
std::optional<Finding> TestLag(const LackOfFitTest& test, const FittedModel& model,
                               const LogSamples& measurements, Eigen::VectorXd& residual,
                               ErrorLevel& level);

}  // namespace warmjoint
