#include "identification/preparation/stretches.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "identification/preparation/position_noise.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kFewSamples = 4;  // samples; why 4: a middle, and neighbours to each side of it
constexpr Index kEnoughStretches =
    32;  // stretches in a log; why: a median of them is known to a fifth of their spread
constexpr double kDeviations = 20;  // why 20: the noise of both ends is 7 % of the change
constexpr double kOneSided =
    0.25;  // of the change; why: at half that speed a joint has not turned round
constexpr double kOfTheTypical = 0.01;  // of a change; why: less is a creep at rest
// why: longer stretches leave out the samples around turning points
constexpr double kNearlyAll = 0.8;
constexpr double kTurn = 2 * std::numbers::pi, kSlack = 1e-3 * kTurn;  // rad
constexpr double kHidden =
    kTurn / 8;  // rad; why: half of the median of what chance leaves of whole turns

/// Samples within whose step the velocity passes half a turn. [N]
SampleMask PassesHalfATurn(const Measurements& m) {
  SampleMask passes = SampleMask::Constant(m.size(), false);
  const Index n = m.size() - 1;
  const VectorXd steps = m.time.tail(n) - m.time.head(n);
  passes.tail(n) = m.velocity.tail(n).array().abs() * steps.array() > kTurn / 2;
  return passes;
}

/// Whether a sensor that starts its turn again may hide turns within these steps: then the positions change as the velocity says, but
/// for whole turns, or anyhow. A velocity in another unit passes half a turn as well, while the positions change little.
bool MayHideTurns(const Measurements& m, const SampleMask& passes) {
  const bool one_turn = m.position.maxCoeff() - m.position.minCoeff() <= kTurn + kSlack;
  if (m.joint != JointKind::rotary || !one_turn || !passes.any()) return false;
  VectorXd moved = VectorXd::Zero(m.size()), left = moved;
  for (Index i = 1; i < m.size(); ++i) {
    const double way = 0.5 * (m.velocity[i] + m.velocity[i - 1]) * (m.time[i] - m.time[i - 1]);
    moved[i] = std::abs(m.position[i] - m.position[i - 1]);
    left[i] = std::abs(std::remainder(way - (m.position[i] - m.position[i - 1]), kTurn));
  }
  return MedianOf(Chosen(moved, passes)) > kHidden || MedianOf(Chosen(left, passes)) < kHidden;
}

/// The pieces of a log between its gaps, and between steps within which a sensor that starts its turn again may hide turns.
std::vector<SampleRange> UnbrokenPieces(const Measurements& m) {
  const double longest = LongestStep(m.time);
  const SampleMask passes = PassesHalfATurn(m);
  const bool hides = MayHideTurns(m, passes);
  std::vector<Index> starts;
  for (Index i = 1; i < m.size(); ++i) {
    if (m.time[i] - m.time[i - 1] > longest || (hides && passes[i])) starts.push_back(i);
  }
  return CutAt(starts, m.size());
}

/// All stretches of `count` samples that show a change of `clear` (rad or m) or more.
std::vector<Stretch> StretchesOf(const Measurements& m, Index count, double clear,
                                 const std::vector<SampleRange>& pieces) {
  std::vector<Stretch> stretches;
  for (Index first = 0; first + count < m.size(); first += count) {
    const Index middle = first + count / 2, last = first + count;
    const double change = m.position[last] - m.position[first];
    const double share = (m.position[middle] - m.position[first]) / change;
    const bool is_whole = last < PieceAt(pieces, first).end();
    if (!is_whole || !(std::abs(change) >= clear && share > kOneSided && share < 1 - kOneSided))
      continue;
    stretches.push_back({first, middle, last, change, m.time[last] - m.time[first]});
  }
  return stretches;
}

/// Leaves out stretches with a much smaller change than the typical one.
void LeaveOutCreeping(std::vector<Stretch>& stretches) {
  const auto change = [](const Stretch& one) { return std::abs(one.change); };
  std::ranges::sort(stretches, {}, change);
  double all = 0, until = 0;
  for (const Stretch& one : stretches) all += change(one);
  // half of the whole path was covered in stretches up to the typical one
  const auto typical = std::ranges::find_if(stretches, [&](const Stretch& one) {
    until += change(one);
    return until >= all / 2;
  });
  if (typical == stretches.end()) return;
  const double least = kOfTheTypical * change(*typical);
  std::erase_if(stretches, [&](const Stretch& one) { return change(one) < least; });
  std::ranges::sort(stretches, {}, &Stretch::first);
}

}  // namespace

std::vector<Stretch> FindStretches(const Measurements& m) {
  const double clear = kDeviations * MeasurePositionNoise(m.position).deviation;
  const std::vector<SampleRange> pieces = UnbrokenPieces(m);
  std::vector<Stretch> longest;
  double most = 0;  // change of all, rad or m
  for (Index count = kFewSamples; count == kFewSamples || count * kEnoughStretches <= m.size();
       count *= 2) {
    std::vector<Stretch> stretches = StretchesOf(m, count, clear, pieces);
    LeaveOutCreeping(stretches);
    double change = 0;
    for (const Stretch& one : stretches) change += std::abs(one.change);
    if (change < kNearlyAll * most) continue;
    longest = std::move(stretches);
    most = std::max(most, change);
  }
  return longest;
}

}  // namespace warmjoint
