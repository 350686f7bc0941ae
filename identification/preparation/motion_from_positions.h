// The motion of a joint as its positions tell it: one speed for each segment, and the whole path.
#pragma once

#include <warmjoint/recording.h>

namespace warmjoint {

/// A log whose velocities follow from its positions.
struct PositionMotion {
  Measurements measurements;
  Selection selection;  // of `measurements`; what was put in is not kept
  /// Most of the path, as a share of all of it, that a drive would not have travelled whose ramps no
  /// sample shows (SplitLog::unseen).
  double unseen = 0;
};

/// Velocities such that the sum of |v| h, with v held until the next sample, is the path that the
/// positions tell, changes of speed included; that is what warms the joint.
///
/// - Each segment has one velocity, the slope of its positions, with a drift where the positions
///   bend by more than four standard errors.
/// - Where the way from one segment to the next is one change of speed (speed_change.h), segments
///   reach as near to it as their positions stay on their line, and samples put in follow it: eight
///   for a ramp, one where the speed turns or jumps. A ramp that no sample shows takes the
///   acceleration of those that samples show, where these have one.
/// - Any other way has the speed from sample to sample along its monotone stretches
///   (monotone_path.h); there the segments keep the samples that they were given.
///
/// Works from recording to recording (Measurements::starts), and not across gaps, where the last
/// velocity holds. selection: segments that move at a constant speed; rests: those that stand.
/// Linear in the number of samples.
PositionMotion MotionFromPositions(const Measurements& measurements, const Selection& selection,
                                   const std::vector<Segment>& rests);

}  // namespace warmjoint
