// The motion of a joint by its positions: one speed for each segment, and the whole path.
#pragma once

#include <warmjoint/recording.h>

#include "identification/preparation/insert_samples.h"
#include "identification/preparation/select.h"

namespace warmjoint {

/// Velocities such that the sum of |v| h, with v held until the next sample, is the path that the
/// positions show, changes of speed included; that is what warms the joint.
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
/// Not across gaps, where the last velocity holds. found: segments that move at a constant speed,
/// and those that stand. Linear in the number of samples.
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
