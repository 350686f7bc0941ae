// The path that a velocity column tells, against the path of the positions.
#pragma once

#include <warmjoint/recording.h>

#include <optional>
#include <vector>

namespace warmjoint {

/// By how much two tellings of a speed may differ, relative, and count as the same.
inline constexpr double kSameSpeed = 0.02;

/// From the middle of a segment to the middle of the next.
struct Transition {
  Eigen::Index first = 0, last = 0;  // samples
  double length = 0;                 // path of the positions, rad or m
  double difference = 0;             // path of the velocities less that, rad or m
};

/// The path sum |v| h, way by way.
struct PathComparison {
  double excess = 0;  // path of the velocities / path of the positions - 1
  double error = 0;   // its standard error, from the scatter over the ways
  std::vector<Transition> ways;
};

/// Compares two versions of one log, each with the velocity held until the next sample:
/// `by_velocity` as its velocity column tells it, `by_position` as its positions do
/// (motion_from_positions.h). Ways count where both agree on the speeds of their two segments to
/// 2 %, so that a position that is stuck or wrapped for a while tells nothing, and where no gap and
/// no start lies between. segments: of the log as it was taken, whose sample times are `time`.
/// Nothing with fewer than 8 ways.
std::optional<PathComparison> ComparePaths(const Measurements& by_velocity,
                                           const Measurements& by_position,
                                           const std::vector<Segment>& segments,
                                           const Measurements& taken);

/// Whether the positions contradict the velocity column: the paths differ by more than 0.1 %, which
/// moves the thermal gain by as much, and by more than four standard errors.
bool Contradicts(const PathComparison& paths);

/// Whether the positions tell the ways better than the velocity column does, which knows nothing of what the speed does
/// between two samples. Where a speed turns, the path is twice as uncertain as the position s of a sample, so that the
/// mean square D of the differences has 4 s^2 from the positions and D - 4 s^2 from the column: D > 8 s^2. Where the
/// two differ by less than 0.01 % of a way, no interval is narrow enough to tell. deviation: s, rad or m
bool PositionsTellMore(const PathComparison& paths, double deviation);

}  // namespace warmjoint
