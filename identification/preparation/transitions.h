// The path from one segment to the next: samples put in for the part of a change of speed that the positions show and a
// velocity column lacks.
#pragma once

#include <warmjoint/prepared_log.h>

#include <optional>
#include <vector>

namespace warmjoint {

/// A sample to be put in.
struct InsertedSample {
  Eigen::Index after = 0;  // the sample before it
  double time = 0;         // s, between that sample and the next
  double position = 0;     // rad or m
  double velocity = 0;     // rad/s or m/s, until the next sample
};

/// A log with samples put in.
struct FilledLog {
  LogView view;
  /// The largest share of the path that a drive which takes time to reverse would
  /// not have travelled (PreparedLog::unresolved_path).
  double unresolved_path = 0;
  double position_deviation = 0;  // rad or m, of positions that made it
};

/// Puts samples into a log that has none put in, ascending in time: with the torque and the other
/// columns of the sample after them, and not kept, so that only the thermal filter sees them. Segments
/// keep their samples.
void InsertSamples(const std::vector<InsertedSample>& inserted, LogView& log);

/// The largest part of the path, rad or m, that a reversal from v0 to v1 may lack where it is taken for a switch: a
/// ramp that no sample shows lasts at most twice the time to the nearer sample. nearer: that time, s;
/// v0, v1: rad/s or m/s. 0 where the speed does not turn.
double UnresolvedAt(double v0, double v1, double nearer);

/// The path sum |v| h, each velocity held until the next sample, rad or m.
double HeldPath(const Measurements& measurements);

/// A thermal filter holds the loss of each sample until the next one. Where the speed changes
/// between two samples at v0 and v1, that charges the rest of the old speed and none of the new
/// one. The positions show when it changed: a switch at t0 + s, v0 s + v1 (h - s) = p1 - p0, gets a
/// sample of its own, with the speed and the torque of the sample after it. Nothing is put in
/// where the speed changes by less than a tenth of its rms or in a ramp that samples show, where
/// the positions contradict the speeds (s outside of the interval), or across a gap. A reversal may
/// hide a ramp of duration D, at most twice the time to the nearer sample, that loses D v0 v1 / (v0 + v1)
/// of the path: FilledLog::unresolved_path. Nothing where no switch is found.
std::optional<FilledLog> SplitAtSwitches(const LogView& log);

/// By how much two velocities may differ, relative, and count as the same.
inline constexpr double kSameSpeed = 0.02;

/// From the middle of a segment to the middle of the next.
struct Transition {
  Eigen::Index first = 0, last = 0;  // samples
  double length = 0;                 // path of the positions, rad or m
  double difference = 0;             // path of the velocities less that, rad or m
};

/// The path sum |v| h, transition by transition.
struct PathComparison {
  double excess = 0;  // path of the velocities / path of the positions - 1
  double error = 0;   // its standard error, from the scatter over the transitions
  std::vector<Transition> transitions;
};

/// Compares two versions of one log, each with the velocity held until the next sample:
/// `by_velocity` by its velocity column, `by_position` by its positions (motion_from_positions.h).
/// Transitions count where both agree on the speeds of their two segments to 2 %, so that a position
/// that is stuck or wrapped for a while does not count, and where no gap lies between. segments: of the
/// log as it was taken, whose sample times are `time`. Nothing with fewer than 8 transitions.
std::optional<PathComparison> ComparePaths(const Measurements& by_velocity,
                                           const Measurements& by_position,
                                           const std::vector<Segment>& segments,
                                           const Measurements& taken);

/// Whether the positions contradict the velocity column: the paths differ by more than 0.1 %, which
/// biases the thermal gain by as much, and by more than four standard errors.
bool Contradicts(const PathComparison& paths);

/// Whether the positions determine the transitions better than the velocity column does, which does not show how the speed
/// changes between two samples. Where a speed turns, the path is twice as uncertain as the position s of a sample, so that
/// the mean square D of the differences has 4 s^2 from the positions and D - 4 s^2 from the column: D > 8 s^2. Where the
/// two differ by less than 0.01 % of a transition's length, no interval is narrow enough to show it. deviation: s, rad or m
bool PositionsTellMore(const PathComparison& paths, double deviation);

/// A log with samples put in, `by_velocity`, where the path of each of the transitions becomes that of another one,
/// `by_position`: the samples of a transition that are not kept have the velocity of the latter, and the samples put in
/// are its samples, with one right after the last sample of a segment; nothing is put in within one. So the losses of a
/// change of speed are those of its path, whatever the velocity does between two samples. Transitions whose difference is
/// larger than samples can hide, one step at the change of speed, stay as they are, since one of the two is faulty there.
/// taken: the N samples that both have; its selection is that of the result, with the samples put in not kept.
/// by_velocity, by_position: of SplitAtSwitches and of motion_from_positions.h
LogView ReplaceTransitions(const LogView& taken, const LogSamples& by_velocity,
                           const LogSamples& by_position,
                           const std::vector<Transition>& transitions);

}  // namespace warmjoint
