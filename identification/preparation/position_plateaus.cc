#include "identification/preparation/position_plateaus.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "models/foundation/robust_noise.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kPasses = 3;         // lines and changes of speed, in turn
constexpr Index kBeside = 10;      // samples of a segment that must follow a change next to it
constexpr Index kHiddenShare = 6;  // of a segment at each end, as a divisor
constexpr double kStraight = 2;    // deviations of the positions
// of the travel of a segment: an error of the path that does not matter
constexpr double kHarmless = 2e-4;
constexpr double kCertain = 4;        // standard errors
constexpr double kShareOfEnd = 0.15;  // of a bent segment, whose end a line follows
constexpr double kMostOfEnd = 0.45;
constexpr Index kFewestOfEnd = 6;         // samples
constexpr size_t kFewestRamps = 5;        // that show the acceleration of others
constexpr double kOneAcceleration = 0.1;  // median deviation, of the acceleration

/// The median acceleration of the ramps that samples show; nothing where they are few or differ.
std::optional<double> OneAcceleration(const std::vector<std::optional<SpeedChange>>& changes) {
  std::vector<double> shown;
  for (const auto& change : changes) {
    if (change && change->duration > 0) shown.push_back(change->Leap() / change->duration);
  }
  if (shown.size() < kFewestRamps) return std::nullopt;

  // their distances from the median
  const double acceleration = MedianOf(shown);
  for (double& one : shown) one = std::abs(one - acceleration);
  if (MedianOf(shown) > kOneAcceleration * acceleration) return std::nullopt;
  return acceleration;
}

/// Gives the changes of speed whose ramp no sample shows the acceleration of those that samples do
/// show, where all of these have about the same, since a drive has one limit. A ramp that reached past a sample would be
/// seen. time: [N] s; changes: those that were found, with duration 0 where no ramp shows
void ShareAcceleration(const Eigen::VectorXd& time,
                       std::vector<std::optional<SpeedChange>>& changes) {
  const auto acceleration = OneAcceleration(changes);
  if (!acceleration) return;
  const double *const begin = time.data(), *const end = begin + time.size();
  for (auto& change : changes) {
    if (!change || change->duration > 0) continue;
    // twice the time to the nearest sample at most
    const double* const behind = std::upper_bound(begin, end, change->time);
    if (behind == begin || behind == end) continue;
    const double nearest = std::min(*behind - change->time, change->time - *(behind - 1));
    change->duration = std::min(change->Leap() / *acceleration, 2 * nearest);
  }
}

/// Finds plateaus in one recording.
class PlateauSearch {
 public:
  PlateauSearch(const Measurements& log, const ConstantSpeed& given) : time_(log.time) {
    const auto [steps, step, resolution] = FromFirst(log.position);
    found_.position = step * steps;
    found_.keep = given.selection.keep;
    found_.pieces = PiecesOf(time_);
    found_.noise = MeasurePositionNoise(found_.position, resolution);
    for (const Segment& one : given.selection.segments) Add(one, true);
    for (const Segment& one : given.rests) Add(one, false);
    std::ranges::sort(found_.plateaus, {}, &Plateau::begin);
    JoinFragments();
    found_.changes.resize(found_.plateaus.empty() ? 0 : found_.plateaus.size() - 1);
  }

  PositionPlateaus Solve() && {
    for (int pass = 0; pass < kPasses; ++pass) {
      FitLines();
      for (size_t i = 0; i + 1 < found_.plateaus.size(); ++i) found_.changes[i] = FindChange(i);
    }
    ShareAcceleration(time_, found_.changes);
    for (size_t i = 0; i + 1 < found_.plateaus.size(); ++i) {
      if (found_.changes[i]) Extend(i);
    }
    ReachToEnds();
    KeepWhatIsOnTheLine();
    LeaveLastSamples();
    return std::move(found_);
  }

 private:
  void Add(const Segment& segment, bool moves) {
    found_.plateaus.push_back({segment.begin, segment.end, moves, {}, 0, true});
  }

  /// Samples of a plateau that no change of speed next to it touches: an end at which the change is
  /// not known yet is taken to hide some of it.
  std::pair<Index, Index> Untouched(size_t i) const {
    Index first = found_.plateaus[i].begin, last = found_.plateaus[i].end - 1;
    const Index hidden = (last - first + 1) / kHiddenShare;
    if (i == 0 || !found_.changes[i - 1]) first += hidden;
    if (i >= found_.changes.size() || !found_.changes[i]) last -= hidden;
    if (i > 0 && found_.changes[i - 1]) {
      const double from = found_.changes[i - 1]->end() + found_.changes[i - 1]->margin;
      while (first < last && time_[first] <= from) ++first;
    }
    if (i < found_.changes.size() && found_.changes[i]) {
      const double until = found_.changes[i]->begin() - found_.changes[i]->margin;
      while (last > first && time_[last] >= until) --last;
    }
    return {first, last};
  }

  /// Joins neighbours whose samples, and those between them, lie on one line: a velocity that was
  /// smoothed from counts rings, so that the choice by velocity may have cut one speed to pieces.
  void JoinFragments() {
    const SampleMask all = SampleMask::Constant(time_.size(), true);
    std::vector<Plateau> joined;
    for (const Plateau& next : found_.plateaus) {
      if (joined.empty() || !LieOnOneLine(joined.back(), next, all)) {
        joined.push_back(next);
      } else {
        joined.back().end = next.end;
      }
    }
    found_.plateaus = std::move(joined);
  }

  bool LieOnOneLine(const Plateau& one, const Plateau& next, const SampleMask& all) const {
    if (one.moves != next.moves || HasGap(one.end - 1, next.begin)) return false;
    auto line = FitStraightLine(time_, found_.position, one.begin, next.end - 1, all);
    if (!line) return false;
    line->deviation = found_.noise.deviation;
    for (Index n = one.begin; n < next.end; ++n) {
      if (!IsOn(*line, n)) return false;
    }
    return true;
  }

  void FitLines() {
    SampleMask use = found_.keep;
    for (size_t i = 0; i < found_.plateaus.size(); ++i) {
      Plateau& plateau = found_.plateaus[i];
      if (!plateau.moves) use.segment(plateau.begin, plateau.end - plateau.begin).setConstant(true);
      const auto [first, last] = Untouched(i);
      plateau.line = FitStraightLine(time_, found_.position, first, last, use);
      if (!plateau.line) continue;
      plateau.is_straight = plateau.line->deviation <= kStraight * found_.noise.deviation;
      plateau.line->deviation = std::max(plateau.line->deviation, found_.noise.deviation);
      plateau.drift = plateau.is_straight ? 0 : FindDrift(plateau, first, last, use);
    }
  }

  /// Slope of the velocity, from the bend of the positions beyond their line. The bend of a segment
  /// is that of b (x^2 - mean x^2), x the time from its middle.
  double FindDrift(const Plateau& plateau, Index first, Index last, const SampleMask& use) const {
    const StraightLine& line = *plateau.line;
    const double mean = line.spread / line.samples;
    double product = 0, squares = 0, strays = 0;
    for (Index i = first; i <= last; ++i) {
      if (!use[i]) continue;
      const double bend = std::pow(time_[i] - line.time, 2) - mean;
      const double stray = found_.position[i] - line.At(time_[i]);
      product += bend * stray;
      squares += bend * bend;
      strays += stray * stray;
    }
    if (squares == 0 || line.samples < 4) return 0;
    const double bent = product / squares;
    const double left = std::max(strays - bent * product, 0.0) / (line.samples - 3);
    const bool shows = std::abs(bent) > kCertain * std::sqrt(left / squares);
    return shows ? 2 * bent : 0;
  }

  /// The line of a plateau where it meets the change of speed after it (or before it): that of its
  /// end where its positions bend.
  std::optional<StraightLine> LineAtEnd(size_t i, bool behind) const {
    const Plateau& plateau = found_.plateaus[i];
    if (!plateau.line || plateau.is_straight) return plateau.line;
    const auto [first, last] = Untouched(i);
    const Index all = last - first + 1;
    const auto share = static_cast<Index>(kShareOfEnd * static_cast<double>(all));
    const auto most = static_cast<Index>(kMostOfEnd * static_cast<double>(all));
    const Index count = std::min(std::max(share, kFewestOfEnd), std::max<Index>(most, 2));
    const Index from = behind ? last - count + 1 : first;
    auto line = FitStraightLine(time_, found_.position, from, from + count - 1,
                                SampleMask::Constant(time_.size(), true));
    if (line) line->deviation = std::max(line->deviation, found_.noise.deviation);
    return line;
  }

  /// rad or m
  double TravelOf(const Plateau& plateau) const {
    return std::abs(plateau.line->slope) * (time_[plateau.end - 1] - time_[plateau.begin]);
  }

  bool HasGap(Index first, Index last) const { return PieceAt(found_.pieces, first).end() <= last; }

  /// The change of speed between plateaus i and i + 1, if the transition between them is one.
  std::optional<SpeedChange> FindChange(size_t i) const {
    const Plateau &one = found_.plateaus[i], &next = found_.plateaus[i + 1];
    if (HasGap(one.end - 1, next.begin)) return std::nullopt;
    const auto before = LineAtEnd(i, true), behind = LineAtEnd(i + 1, false);
    if (!before || !behind) return std::nullopt;
    const Index between = next.begin - one.end;
    const Index beside = std::max(kBeside, between);
    const Index first = std::max((one.begin + one.end) / 2, one.end - beside);
    const Index last = std::min((next.begin + next.end) / 2, next.begin + beside);

    // the error of positions, which is taken to be at least what does not matter compared with the travel of a segment
    PositionNoise noise = found_.noise;
    noise.reach = std::max(noise.reach, kHarmless * std::min(TravelOf(one), TravelOf(next)));
    return FindSpeedChange(time_, found_.position, *before, *behind, first, last, noise);
  }

  /// Lets the plateaus next to a change of speed reach to its margins, or shrink to them.
  void Extend(size_t i) {
    Plateau &one = found_.plateaus[i], &next = found_.plateaus[i + 1];
    const double until = found_.changes[i]->begin() - found_.changes[i]->margin;
    const double from = found_.changes[i]->end() + found_.changes[i]->margin;
    Index end = one.end, begin = next.begin;
    while (end < next.begin && time_[end] < until) found_.keep[end++] = one.moves;
    while (end > one.begin && time_[end - 1] >= until) found_.keep[--end] = false;
    while (begin > end && time_[begin - 1] > from) found_.keep[--begin] = next.moves;
    while (begin < next.end && time_[begin] <= from) found_.keep[begin++] = false;
    one.end = end;
    next.begin = begin;
  }

  /// Lets a plateau reach the end of the recording, or a gap, where its line leads there.
  void ReachToEnds() {
    for (size_t i = 0; i < found_.plateaus.size(); ++i) {
      Plateau& plateau = found_.plateaus[i];
      if (!plateau.line || !plateau.is_straight) continue;
      // up to the ends of its piece and to its neighbours
      const Index lowest = PieceAt(found_.pieces, plateau.begin).first;
      const Index highest = PieceAt(found_.pieces, plateau.end - 1).end();
      const Index before = i > 0 ? found_.plateaus[i - 1].end : 0;
      const Index behind =
          i + 1 < found_.plateaus.size() ? found_.plateaus[i + 1].begin : time_.size();
      const auto is_on = [&](Index n) { return IsOn(*plateau.line, n); };
      Index begin = plateau.begin, end = plateau.end;
      while (begin > std::max(lowest, before) && is_on(begin - 1)) --begin;
      while (end < std::min(highest, behind) && is_on(end)) ++end;
      if (begin == lowest) {
        while (plateau.begin > begin) found_.keep[--plateau.begin] = plateau.moves;
      }
      if (end == highest) {
        while (plateau.end < end) found_.keep[plateau.end++] = plateau.moves;
      }
    }
  }

  bool IsOn(const StraightLine& line, Index n) const {
    return std::abs(found_.position[n] - line.At(time_[n])) <=
           found_.noise.reach + kCertain * line.ErrorAt(time_[n]);
  }

  /// Keeps all samples of a straight plateau that lie on its line: its velocities may have been
  /// smoothed from positions whose noise rings.
  void KeepWhatIsOnTheLine() {
    for (const Plateau& plateau : found_.plateaus) {
      if (!plateau.moves || !plateau.line || !plateau.is_straight) continue;
      for (Index n = plateau.begin; n < plateau.end; ++n) found_.keep[n] = IsOn(*plateau.line, n);
    }
  }

  /// Leaves the last sample of a plateau out of it where the transition is followed from sample to
  /// sample: until the next one, its speed may already change.
  void LeaveLastSamples() {
    for (size_t i = 0; i < found_.plateaus.size(); ++i) {
      Plateau& plateau = found_.plateaus[i];
      const bool is_followed =
          i < found_.changes.size() ? !found_.changes[i] : plateau.end < time_.size();
      if (is_followed && plateau.end - plateau.begin > 1) found_.keep[--plateau.end] = false;
    }
  }

  const VectorXd& time_;  // [N] s
  PositionPlateaus found_;
};

}  // namespace

PositionPlateaus FindPlateaus(const Measurements& log, const ConstantSpeed& found) {
  return PlateauSearch(log, found).Solve();
}

}  // namespace warmjoint
