#include "identification/preparation/stretches.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "identification/preparation/position_noise.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr Index kFewSamples = 4;  // samples; why 4: a middle, and neighbours to each side of it
constexpr Index kEnoughStretches =
    32;  // stretches in a log; why: a median of them is known to a fifth of their spread
constexpr double kDeviations = 20;  // why 20: the noise of both ends is 7 % of the change
constexpr double kOneSided =
    0.25;  // of the change; why: at half that speed a joint has not turned round
constexpr double kOfTheTypical = 0.01;  // of a change; why: less is a creep at rest
// why: longer stretches leave out the samples around turning points
constexpr double kNearlyAll = 0.8;

/// The pieces of a log between its gaps, and between steps within which a sensor that starts its turn again may hide turns.
std::vector<SampleRange> UnbrokenPieces(const Measurements& m) {
  constexpr double turn = 2 * std::numbers::pi, slack = 1e-3 * turn;  // rad
  const double longest = LongestStep(m.time);
  const bool one_turn =
      m.joint == JointKind::rotary && m.position.maxCoeff() - m.position.minCoeff() <= turn + slack;
  std::vector<Index> starts;
  for (Index i = 1; i < m.size(); ++i) {
    const double step = m.time[i] - m.time[i - 1];
    const bool is_hidden = one_turn && std::abs(m.velocity[i]) * step > turn / 2;
    if (step > longest || is_hidden) starts.push_back(i);
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
