// Dependence of a residual on an angle: ripple of any period, alike or not in the two directions,
// and ripple that fades as the joint warms up.
#pragma once

#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <optional>

#include "identification/lack_of_fit/fitted_model.h"
#include "identification/lack_of_fit/significance.h"

namespace warmjoint {

/// |sum over n of x[n] exp(-2 pi i k n / length)|^2 for k = 0 to last < length. x: [n], n <= length: zeros follow; length: best
/// a power of 2
Eigen::VectorXd PowerSpectrum(const Eigen::VectorXd& x, Eigen::Index length, Eigen::Index last);

/// Looks for ripple a cos(2 pi f phase) + b sin(2 pi f phase) along the motor's angle or along the
/// travel, as the test is over, with a and b for each direction of motion, one frequency after the
/// other: the strongest is tested by Hotelling's T^2 over kParts parts of the recording, its
/// probability times the number of frequencies (Bonferroni), and subtracted before the next. A residual that is
/// periodic in time only has another phase in each part, so that the test does not reject. Sums the residual into
/// bins in one pass, so that the frequencies cost no pass each. The finding is that of the
/// strongest frequency, and explains as much as all that are found together.
/// residual: [N] tau - F, read where kept; what is found is taken off it.
std::optional<Finding> TestRipple(const LackOfFitTest& test, const FittedModel& model,
                                  const LogSamples& measurements, Eigen::VectorXd& residual,
                                  ErrorLevel& level);

/// The same for a fit with a map over the angle, which follows the ripple at the mean of the speeds: for
/// ripple that changes with the speed, as cos(k pi r) does, k = 1 to 4; r: share of the samples
/// that are slower. The probability counts for each k.
std::optional<Finding> TestRippleBySpeed(const LackOfFitTest& test, const FittedModel& model,
                                         const LogSamples& measurements, Eigen::VectorXd& residual,
                                         ErrorLevel& level);

/// Whether what the maps give varies with the energy, in a fit of maps whose strength is free.
/// residual: [N] tau - F; what is found is taken off it.
std::optional<Finding> TestFading(const LackOfFitTest& test, const FittedModel& model,
                                  const LogSamples& measurements, Eigen::VectorXd& residual,
                                  ErrorLevel& level);

}  // namespace warmjoint
