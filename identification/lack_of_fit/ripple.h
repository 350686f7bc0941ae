// Dependence of a residual on an angle: ripple of any period, alike or not in the two directions,
// and what fades.
#pragma once

#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <optional>

#include "identification/lack_of_fit/fitted_model.h"
#include "identification/lack_of_fit/significance.h"

namespace warmjoint {

/// Looks for ripple a cos(2 pi f phase) + b sin(2 pi f phase) along the motor's angle or along the
/// travel, as the test is over, with a and b for each direction of motion, one frequency after the
/// other: the strongest is tested by Hotelling's T^2 over kParts parts of the recording, its
/// probability times the number of frequencies (Bonferroni), and taken off before the next. What is
/// periodic in time alone has another phase in each part and fails the test. Sums the residual into
/// bins in one pass, so that the frequencies cost no pass each. The finding is that of the
/// strongest frequency, and explains what all that are found explain.
/// residual: [N] tau - F, read where kept; what is found is taken off it.
std::optional<Finding> TestRipple(const LackOfFitTest& test, const FittedModel& model,
                                  const LogSamples& measurements, Eigen::VectorXd& residual,
                                  ErrorLevel& level);

/// The same beside a map over the angle, which follows the ripple at the mean of the speeds, for
/// ripple that changes with the speed, as cos(k pi r) does, k = 1 to 4; r: share of the samples
/// that are slower. The probability counts for each k.
std::optional<Finding> TestRippleBySpeed(const LackOfFitTest& test, const FittedModel& model,
                                         const LogSamples& measurements, Eigen::VectorXd& residual,
                                         ErrorLevel& level);

/// Whether what the maps give goes with the energy, beside maps whose strength is free.
/// residual: [N] tau - F; what is found is taken off it.
std::optional<Finding> TestFading(const LackOfFitTest& test, const FittedModel& model,
                                  const LogSamples& measurements, Eigen::VectorXd& residual,
                                  ErrorLevel& level);

}  // namespace warmjoint
