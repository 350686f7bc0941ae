// The motion of a joint by its positions: their smoothed slope, one speed for each segment, and the whole path.
#pragma once

#include <warmjoint/recording.h>

#include "identification/preparation/select.h"
#include "identification/preparation/transitions.h"

namespace warmjoint {

/// Velocity of a sampled position: a zero-phase Butterworth low-pass (4th order, run forwards and
/// backwards) and central differences. Pieces between gaps (more than three median steps) are
/// treated one by one. A piece whose steps differ by more than 1 % is put on an even grid of its
/// mean step by straight lines, filtered there, and read back at its own times. time: [N] s,
/// increasing; position: [N] rad or m. cutoff: Hz; above 0.4 of the sampling rate there is no
/// filter. Returns [N] rad/s or m/s.
Eigen::VectorXd DeriveVelocity(const Eigen::VectorXd& time, const Eigen::VectorXd& position,
                               double cutoff);

/// A cutoff for DeriveVelocity, in Hz: 100 Hz, which passes the bandwidth of a joint's controller, or less
/// where the noise of the position would otherwise exceed its slope. White noise of standard
/// deviation s on the position leaves sqrt(h (2 pi)^2 2/3 fc^3) s on the velocity (h: step, s);
/// the cutoff is lowered until that is 1 % of the velocity's root mean square, at most to 0.02 of
/// the sampling rate. s comes from the median of the position's fourth differences, or from its
/// resolution (smallest step / sqrt(12)) where that is more.
double ChooseCutoff(const Eigen::VectorXd& time, const Eigen::VectorXd& position);

/// Velocities such that the sum of |v| h, with v held until the next sample, is the path that the
/// positions show, changes of speed included, since this path determines how the joint warms.
///
/// - Each segment has one velocity, the slope of its positions, with a drift where the positions
///   bend by more than four standard errors.
/// - Where the transition from one segment to the next is one change of speed (speed_change.h),
///   segments reach as near to it as their positions stay on their line, and samples put in follow
///   it: eight for a ramp, one where the speed turns or jumps. A ramp that no sample shows takes the
///   acceleration of those that samples show, where these have one.
/// - Any other transition has the speed from sample to sample along its monotone stretches
///   (MonotonePath); there the segments keep the samples that they were given.
///
/// Not across gaps, where the last velocity holds. found: segments of constant speed,
/// and those at rest. The time is linear in the number of samples.
FilledLog MotionFromPositions(const Measurements& measurements, const ConstantSpeed& found);

/// Positions of a joint that turns round only where these lead back by more than `hysteresis`. Each
/// stretch from one turning point to the next is replaced by the monotone sequence nearest to it in
/// least squares (pool adjacent violators; Barlow et al., Statistical Inference under Order
/// Restrictions, 1972, 1.2), whose runs of equal values are joined by straight lines from middle to
/// middle. So noise and the steps of an encoder add nothing to the path sum |p[i+1] - p[i]|, which
/// telescopes, and little to its speed. time: [N] s; position: [N] rad or m; hysteresis: rad or m,
/// above the noise from peak to peak. Returns [N].
Eigen::VectorXd MonotonePath(const Eigen::VectorXd& time, const Eigen::VectorXd& position,
                             double hysteresis);

}  // namespace warmjoint
