// What a slow log does not show: when, between two samples, the speed changed.
#pragma once

#include <warmjoint/recording.h>

#include <optional>

namespace warmjoint {

/// A log with samples put in where the speed switched.
struct SplitLog {
  Measurements measurements;
  Selection selection;  // of `measurements`; what was put in is not kept
  /// Most of the path, as a share of all of it, that a drive which takes its time to reverse would
  /// not have travelled: in a ramp of duration D from v0 to -v1 around the switch, D v0 v1/(v0 +
  /// v1) of it, D at most twice the time to the nearer sample.
  double unseen = 0;
};

/// A thermal filter holds the loss of each sample until the next one. Where the speed changes
/// between two samples at v0 and v1, that charges the rest of the old speed and none of the new
/// one. The positions tell when it changed: a switch at t0 + s, v0 s + v1 (h - s) = p1 - p0, gets a
/// sample of its own, with the speed and the torque of the sample behind it. Nothing is put in
/// where the speed changes by less than a tenth of its rms or in a ramp that samples show, where
/// the positions contradict the speeds (s outside of the interval), or across a gap or a cold
/// start. Values of other columns are those of the sample behind. Nothing where no switch is found.
std::optional<SplitLog> SplitAtSwitches(const Measurements& measurements,
                                        const Selection& selection);

}  // namespace warmjoint
