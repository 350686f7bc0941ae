// One velocity for each segment of constant speed, where noise of the samples' would bias a fit.
#pragma once

#include <warmjoint/prepared_log.h>

#include <optional>

namespace warmjoint {

/// What takes the place of a velocity column: the kept samples have the velocity of their segment.
struct SegmentVelocity {
  Eigen::VectorXd velocity;  // [N] rad/s or m/s
  VelocityNoise noise;
};

/// Least squares over samples whose velocity has noise finds a slope over |v| too small by the
/// share
///
///     a = s_w^2 / (s_w^2 + s_b^2)
///
/// (errors in variables; Fuller, Measurement Error Models, 1987, 1.1), s_w^2 the variance of v
/// around a straight line over each segment, pooled, and s_b^2 the variance of the segments' |v|,
/// weighted by samples. Where a exceeds 0.1 %, the kept samples of a segment get one velocity: the
/// slope of the positions, where it has a smaller error than the mean of the velocities (standard errors
/// sqrt(2) s_p / T, with s_p around the straight line, and s_w / sqrt(n)) and agrees with it to
/// four of these; else that mean. A speed that drifts beyond four standard errors keeps its drift.
/// Nothing where a is less, or no segments are given.
std::optional<SegmentVelocity> TakeSegmentVelocity(const Measurements& measurements,
                                                   const Selection& selection);

/// Step q of a quantised velocity whose rounding the positions show: the mean velocities of the segments differ from the
/// slopes of their positions, in root mean square, by more than four of their standard errors (those above), by more
/// than 0.1 % of the mean speed, which changes a viscous torque by as much, and by q and half of that speed at most. Averaging
/// does not lower such an error, since a constant speed is rounded in one way throughout. rad/s or m/s; nothing for other velocities.
std::optional<double> CoarseStep(const Measurements& measurements, const Selection& selection);

}  // namespace warmjoint
