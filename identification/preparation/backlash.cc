#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "identification/preparation/local_motion.h"
#include "identification/preparation/log_faults.h"
#include "identification/preparation/moving_view.h"
#include "identification/preparation/position_noise.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr double kTurnsBeyond =
    20;  // deviations of the position's noise from a turning point; why: 20 make noise 5 % of a way
constexpr double kMovesBeyond = 4;  // the same, beyond which the joint has moved
constexpr double kHalf =
    0.5;  // of the level; why: a smaller torque is nearer to no friction than to all of it
constexpr double
    kMost = 0.35,
    kLeast =
        -0.25;  // of the level in the gap, in the mean; why: a motor has some friction of its own
constexpr double kFull =
    0.7;  // of the level at once after the gap; why: a bristle or a spring brings it up slowly
constexpr Index kFewestInGap = 2;       // samples; why: one may be late
constexpr Index kBehind = 4;            // samples after the gap, whose median counts
constexpr std::size_t kFewestLegs = 8;  // of motion in one direction
constexpr double kAlike = 0.25;         // of the gap, from leg to leg in the median
constexpr double kOfTheTime =
    0.5;  // of the spread of the times; why: a late torque is late by a time, not by a way
constexpr double kShare =
    0.01;  // of the samples of a fit; why: the error of their torque is all of the friction, 10 % in the rms

/// Motion in one direction, from one turning point to the next.
struct Leg {
  Index begin = 0, end = 0;  // both included
  double direction = 1;
};

/// Legs whose turning points have a distance of `least` or more, without the first and the last: the log has only a part of these.
std::vector<Leg> FindLegs(const Eigen::VectorXd& position, double least) {
  std::vector<Leg> legs;
  Index low = 0, high = 0, from = 0;
  double direction = 0;
  const auto turn = [&](Index at) {
    if (direction != 0) legs.push_back({from, at, direction});
    from = at;
  };
  for (Index i = 1; i < position.size(); ++i) {
    if (direction >= 0 && position[i] > position[high]) high = i;
    if (direction <= 0 && position[i] < position[low]) low = i;
    if (direction >= 0 && position[high] - position[i] > least) {
      turn(high);
      direction = -1;
      low = i;
    } else if (direction <= 0 && position[i] - position[low] > least) {
      turn(low);
      direction = 1;
      high = i;
    }
  }
  if (!legs.empty()) legs.erase(legs.begin());
  return legs;
}

/// Median torque in a direction over the second half of each of its legs, where the joint moves.
double LevelOf(const Measurements& m, const std::vector<Leg>& legs, double direction,
               const SampleMask& moving) {
  std::vector<double> torques;
  for (const Leg& leg : legs) {
    if (leg.direction != direction) continue;
    const double half = kHalf * std::abs(m.position[leg.end] - m.position[leg.begin]);
    for (Index i = leg.begin; i <= leg.end; ++i) {
      if (!moving[i] || std::abs(m.position[i] - m.position[leg.begin]) < half) continue;
      torques.push_back(direction * m.torque[i]);
    }
  }
  return MedianOf(torques);
}

/// What a leg shows after its turning point.
struct Gap {
  double way = 0, time = 0;  // rad or m, s: until the torque is there
  Index first = 0, end = 0;  // samples in it
};

/// The way over which a leg's torque stays small before it jumps to its level; nothing where it does not.
std::optional<Gap> FindGap(const Measurements& m, const Leg& leg, double level, double moved) {
  const auto way = [&](Index i) { return leg.direction * (m.position[i] - m.position[leg.begin]); };
  const auto share = [&](Index i) { return leg.direction * m.torque[i] / level; };
  Index first = leg.begin;
  while (first < leg.end && way(first) <= moved) ++first;
  Index end = first;
  while (end < leg.end && share(end) < kHalf) ++end;
  if (end - first < kFewestInGap || end + kBehind > leg.end) return std::nullopt;

  double mean = 0;
  for (Index i = first; i < end; ++i) mean += share(i) / static_cast<double>(end - first);
  const Eigen::VectorXd behind = leg.direction / level * m.torque.segment(end, kBehind);
  const bool jumps = MedianOf(behind) > kFull && std::max(behind[0], behind[1]) > kFull;
  if (!jumps || mean < kLeast || mean > kMost) return std::nullopt;
  return Gap{(way(end - 1) + way(end)) / 2, (m.time[end - 1] + m.time[end]) / 2 - m.time[first],
             first, end};
}

/// Median, and the median distance from it over it.
std::pair<double, double> MedianAndSpread(const std::vector<Gap>& gaps, double Gap::*of) {
  std::vector<double> values, distances;
  for (const Gap& gap : gaps) values.push_back(gap.*of);
  const double median = MedianOf(values);
  for (const double value : values) distances.push_back(std::abs(value - median));
  return {median, MedianOf(distances) / median};
}

}  // namespace

std::optional<std::string> Backlash(const Measurements& m, const Selection& selection) {
  if (m.position_integrated) return std::nullopt;
  // the level of each direction
  const double noise = MeasurePositionNoise(m.position).deviation;
  const std::vector<Leg> legs = FindLegs(m.position, kTurnsBeyond * noise);
  if (legs.size() < kFewestLegs) return std::nullopt;
  const SampleMask moving = InMotion(m.velocity);
  const double ahead = LevelOf(m, legs, 1, moving), back = LevelOf(m, legs, -1, moving);
  if (!(ahead > 0 && back > 0)) return std::nullopt;

  // gaps of one width, whatever the time in them
  std::vector<Gap> gaps;
  for (const Leg& leg : legs) {
    const double level = leg.direction > 0 ? ahead : back;
    if (const auto gap = FindGap(m, leg, level, kMovesBeyond * noise)) gaps.push_back(*gap);
  }
  if (gaps.size() < kFewestLegs || 2 * gaps.size() < legs.size()) return std::nullopt;
  const auto [width, spread] = MedianAndSpread(gaps, &Gap::way);
  if (!(spread < kAlike && spread < kOfTheTime * MedianAndSpread(gaps, &Gap::time).second)) {
    return std::nullopt;
  }

  // the part of the gaps that a fit takes
  const SampleMask used = HoldsSpeeds(m, selection) ? selection.keep : moving;
  Index within = 0;
  for (const Gap& gap : gaps) within += used.segment(gap.first, gap.end - gap.first).count();
  if (static_cast<double>(within) < kShare * static_cast<double>(used.count())) return std::nullopt;
  return fmt::format(
      "behind {} of {} reversals the torque stays small for {:.3g} {} and then jumps, as with "
      "backlash between the motor and the joint: record holds of a speed, each longer than that, "
      "or log position and torque on one side of the gear",
      gaps.size(), legs.size(), width, kPositionUnit.For(m.joint));
}

}  // namespace warmjoint
