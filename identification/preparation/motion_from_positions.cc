#include "identification/preparation/motion_from_positions.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "identification/preparation/insert_samples.h"
#include "identification/preparation/monotone_path.h"
#include "identification/preparation/position_noise.h"
#include "identification/preparation/speed_change.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/recordings_of.h"
#include "models/recording/sampling.h"

namespace warmjoint::inline identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kPasses = 3;          // lines and changes of speed, in turn
constexpr int kPiecesOfRamp = 8;    // in which its speed is held
constexpr Index kBeside = 10;       // samples of a segment that must follow a change beside it
constexpr Index kHiddenShare = 6;   // of a segment at each end, as a divisor
constexpr double kStraight = 2;     // deviations of the positions
constexpr double kHarmless = 2e-4;  // of the way of a segment: the path may be off by as much
constexpr double kCertain = 4;      // standard errors
constexpr size_t kFewestRamps = 5;  // that tell the acceleration of others
constexpr double kOneAcceleration = 0.1;  // median deviation, of the acceleration
constexpr double kHysteresis = 6;         // reaches
constexpr double kAtSample = 1e-6;        // of a step: nearer to a sample is at it
constexpr double kShareOfEnd = 0.15;      // of a bent segment, whose end a line follows
constexpr double kMostOfEnd = 0.45;
constexpr Index kFewestOfEnd = 6;  // samples

/// A segment at one speed, or a rest.
struct Plateau {
  Index begin = 0, end = 0;  // samples
  bool moves = false;
  std::optional<PositionLine> line;
  double drift = 0;         // of the velocity, rad/s^2 or m/s^2; 0 where it does not show
  bool is_straight = true;  // its positions lie on its line
};

/// Positions less the first, [N] rad or m.
VectorXd Relative(const VectorXd& position) {
  const auto [steps, step] = FromFirst(position);
  return step * steps;
}

/// One recording of the log.
class RecordingMotion {
 public:
  RecordingMotion(const Measurements& log, const Selection& selection,
                  const std::vector<Segment>& rests, SampleRange range)
      : log_(log),
        first_(range.first),
        count_(range.count),
        time_(log.time.segment(first_, count_)),
        position_(Relative(log.position.segment(first_, count_))),
        velocity_(log.velocity.segment(first_, count_)),
        keep_(selection.keep.segment(first_, count_)),
        longest_(LongestStep(time_)),
        noise_(MeasurePositionNoise(position_)) {
    for (const Segment& segment : selection.segments) Add(segment, true);
    for (const Segment& rest : rests) Add(rest, false);
    std::ranges::sort(plateaus_, {}, &Plateau::begin);
    JoinFragments();
    changes_.resize(plateaus_.empty() ? 0 : plateaus_.size() - 1);
  }

  /// Finds lines and changes of speed, and takes the motion from them.
  void Solve() {
    for (int pass = 0; pass < kPasses; ++pass) {
      FitLines();
      for (size_t i = 0; i + 1 < plateaus_.size(); ++i) changes_[i] = FindChange(i);
    }
    ShareAcceleration();
    for (size_t i = 0; i + 1 < plateaus_.size(); ++i) {
      if (changes_[i]) Extend(i);
    }
    ReachToEnds();
    KeepWhatIsOnTheLine();
    LeaveLastSamples();
    for (const Plateau& plateau : plateaus_) TakeSpeed(plateau);
    TakeWayBefore();
    for (size_t i = 0; i + 1 < plateaus_.size(); ++i) TakeWay(i);
    TakeWayBehind();
  }

  const VectorXd& velocity() const { return velocity_; }
  const Eigen::Array<bool, Eigen::Dynamic, 1>& keep() const { return keep_; }
  const std::vector<InsertedSample>& inserted() const { return inserted_; }
  double unseen() const { return unseen_; }

  /// The segments with the samples that they reached.
  void AddSegments(std::vector<Segment>& segments) const {
    for (const Plateau& plateau : plateaus_) {
      if (!plateau.moves || plateau.end <= plateau.begin) continue;
      const double speed = plateau.line ? plateau.line->velocity : velocity_[plateau.begin];
      segments.push_back({first_ + plateau.begin, first_ + plateau.end, speed});
    }
  }

 private:
  void Add(const Segment& segment, bool moves) {
    if (segment.begin < first_ || segment.begin >= first_ + count_) return;
    plateaus_.push_back({segment.begin - first_, segment.end - first_, moves, {}, 0, true});
  }

  /// Samples of a plateau that no change of speed beside it touches: an end at which the change is
  /// not known yet is taken to hide some of it.
  std::pair<Index, Index> Untouched(size_t i) const {
    Index first = plateaus_[i].begin, last = plateaus_[i].end - 1;
    const Index hidden = (last - first + 1) / kHiddenShare;
    if (i == 0 || !changes_[i - 1]) first += hidden;
    if (i >= changes_.size() || !changes_[i]) last -= hidden;
    if (i > 0 && changes_[i - 1]) {
      const double from = changes_[i - 1]->end() + changes_[i - 1]->margin;
      while (first < last && time_[first] <= from) ++first;
    }
    if (i < changes_.size() && changes_[i]) {
      const double until = changes_[i]->begin() - changes_[i]->margin;
      while (last > first && time_[last] >= until) --last;
    }
    return {first, last};
  }

  /// Joins neighbours whose samples, and those between them, lie on one line: a velocity that was
  /// smoothed from counts rings, so that the choice by velocity may have cut one speed to pieces.
  void JoinFragments() {
    const Eigen::Array<bool, Eigen::Dynamic, 1> all =
        Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(count_, true);
    std::vector<Plateau> joined;
    for (const Plateau& next : plateaus_) {
      if (joined.empty() || !LieOnOneLine(joined.back(), next, all)) {
        joined.push_back(next);
      } else {
        joined.back().end = next.end;
      }
    }
    plateaus_ = std::move(joined);
  }

  bool LieOnOneLine(const Plateau& one, const Plateau& next,
                    const Eigen::Array<bool, Eigen::Dynamic, 1>& all) const {
    if (one.moves != next.moves || HasGap(one.end - 1, next.begin)) return false;
    auto line = FitPositionLine(time_, position_, one.begin, next.end - 1, all);
    if (!line) return false;
    line->deviation = noise_.deviation;
    for (Index n = one.begin; n < next.end; ++n) {
      if (!IsOn(*line, n)) return false;
    }
    return true;
  }

  void FitLines() {
    Eigen::Array<bool, Eigen::Dynamic, 1> use = keep_;
    for (size_t i = 0; i < plateaus_.size(); ++i) {
      Plateau& plateau = plateaus_[i];
      if (!plateau.moves) use.segment(plateau.begin, plateau.end - plateau.begin).setConstant(true);
      const auto [first, last] = Untouched(i);
      plateau.line = FitPositionLine(time_, position_, first, last, use);
      if (!plateau.line) continue;
      plateau.is_straight = plateau.line->deviation <= kStraight * noise_.deviation;
      plateau.line->deviation = std::max(plateau.line->deviation, noise_.deviation);
      plateau.drift = plateau.is_straight ? 0 : FindDrift(plateau, first, last, use);
    }
  }

  /// Slope of the velocity, from the bend of the positions beyond their line. The bend of a segment
  /// is that of b (x^2 - mean x^2), x the time from its middle.
  double FindDrift(const Plateau& plateau, Index first, Index last,
                   const Eigen::Array<bool, Eigen::Dynamic, 1>& use) const {
    const PositionLine& line = *plateau.line;
    const double mean = line.spread / line.samples;
    double product = 0, squares = 0, strays = 0;
    for (Index i = first; i <= last; ++i) {
      if (!use[i]) continue;
      const double bend = std::pow(time_[i] - line.time, 2) - mean;
      const double stray = position_[i] - line.At(time_[i]);
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

  /// The line of a plateau where it meets the change of speed behind it (or before it): that of its
  /// end where its positions bend.
  std::optional<PositionLine> LineAtEnd(size_t i, bool behind) const {
    const Plateau& plateau = plateaus_[i];
    if (!plateau.line || plateau.is_straight) return plateau.line;
    const auto [first, last] = Untouched(i);
    const Index all = last - first + 1;
    const auto share = static_cast<Index>(kShareOfEnd * static_cast<double>(all));
    const auto most = static_cast<Index>(kMostOfEnd * static_cast<double>(all));
    const Index count = std::min(std::max(share, kFewestOfEnd), std::max<Index>(most, 2));
    const Index from = behind ? last - count + 1 : first;
    auto line = FitPositionLine(time_, position_, from, from + count - 1,
                                Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(count_, true));
    if (line) line->deviation = std::max(line->deviation, noise_.deviation);
    return line;
  }

  /// rad or m
  double WayOf(const Plateau& plateau) const {
    return std::abs(plateau.line->velocity) * (time_[plateau.end - 1] - time_[plateau.begin]);
  }

  bool HasGap(Index first, Index last) const {
    for (Index i = first; i < last; ++i) {
      if (time_[i + 1] - time_[i] > longest_) return true;
    }
    return false;
  }

  /// The change of speed between plateaus i and i + 1, if the way between them is one.
  std::optional<SpeedChange> FindChange(size_t i) const {
    const Plateau &one = plateaus_[i], &next = plateaus_[i + 1];
    if (HasGap(one.end - 1, next.begin)) return std::nullopt;
    const auto before = LineAtEnd(i, true), behind = LineAtEnd(i + 1, false);
    if (!before || !behind) return std::nullopt;
    const Index between = next.begin - one.end;
    const Index beside = std::max(kBeside, between);
    const Index first = std::max((one.begin + one.end) / 2, one.end - beside);
    const Index last = std::min((next.begin + next.end) / 2, next.begin + beside);

    // what positions may be off, at least as much as does not matter beside the way of a segment
    PositionNoise noise = noise_;
    noise.reach = std::max(noise.reach, kHarmless * std::min(WayOf(one), WayOf(next)));
    return FindSpeedChange(time_, position_, *before, *behind, first, last, noise);
  }

  /// Gives the changes of speed whose ramp no sample shows the acceleration of those that samples do
  /// show, where that is one: a drive has one limit. A ramp that would reach past a sample would
  /// have shown.
  void ShareAcceleration() {
    std::vector<double> shown;
    for (const auto& change : changes_) {
      if (change && change->duration > 0) shown.push_back(change->Leap() / change->duration);
    }
    if (shown.size() < kFewestRamps) return;
    using Column = Eigen::Map<const VectorXd>;
    VectorXd all = Column(shown.data(), static_cast<Index>(shown.size()));
    const double acceleration = MedianInPlace(all);
    all = (all.array() - acceleration).abs();
    if (MedianInPlace(all) > kOneAcceleration * acceleration) return;

    for (auto& change : changes_) {
      if (!change || change->duration > 0) continue;
      const double* begin = time_.data();
      const auto behind = std::upper_bound(begin, begin + count_, change->time) - begin;
      if (behind == 0 || behind == count_) continue;
      const double nearest =
          std::min(time_[behind] - change->time, change->time - time_[behind - 1]);
      change->duration = std::min(change->Leap() / acceleration, 2 * nearest);
    }
  }

  /// Lets the plateaus beside a change of speed reach to its margins, or shrink to them.
  void Extend(size_t i) {
    Plateau &one = plateaus_[i], &next = plateaus_[i + 1];
    const double until = changes_[i]->begin() - changes_[i]->margin;
    const double from = changes_[i]->end() + changes_[i]->margin;
    Index end = one.end, begin = next.begin;
    while (end < next.begin && time_[end] < until) keep_[end++] = one.moves;
    while (end > one.begin && time_[end - 1] >= until) keep_[--end] = false;
    while (begin > end && time_[begin - 1] > from) keep_[--begin] = next.moves;
    while (begin < next.end && time_[begin] <= from) keep_[begin++] = false;
    one.end = end;
    next.begin = begin;
  }

  /// Lets a plateau reach the end of the recording, or a gap, where its line leads there.
  void ReachToEnds() {
    for (size_t i = 0; i < plateaus_.size(); ++i) {
      Plateau& plateau = plateaus_[i];
      if (!plateau.line || !plateau.is_straight) continue;
      const Index lowest = i > 0 ? plateaus_[i - 1].end : 0;
      const Index highest = i + 1 < plateaus_.size() ? plateaus_[i + 1].begin : count_;
      const auto is_on = [&](Index n) { return IsOn(*plateau.line, n); };
      Index begin = plateau.begin, end = plateau.end;
      while (begin > lowest && is_on(begin - 1) && time_[begin] - time_[begin - 1] <= longest_) {
        --begin;
      }
      while (end < highest && is_on(end) && time_[end] - time_[end - 1] <= longest_) ++end;
      if (begin == 0 || (begin > 0 && time_[begin] - time_[begin - 1] > longest_)) {
        while (plateau.begin > begin) keep_[--plateau.begin] = plateau.moves;
      }
      if (end == count_ || (end < count_ && time_[end] - time_[end - 1] > longest_)) {
        while (plateau.end < end) keep_[plateau.end++] = plateau.moves;
      }
    }
  }

  bool IsOn(const PositionLine& line, Index n) const {
    return std::abs(position_[n] - line.At(time_[n])) <=
           noise_.reach + kCertain * line.ErrorAt(time_[n]);
  }

  /// Keeps all samples of a straight plateau that lie on its line: its velocities may have been
  /// smoothed from positions whose noise rings.
  void KeepWhatIsOnTheLine() {
    for (const Plateau& plateau : plateaus_) {
      if (!plateau.moves || !plateau.line || !plateau.is_straight) continue;
      for (Index n = plateau.begin; n < plateau.end; ++n) keep_[n] = IsOn(*plateau.line, n);
    }
  }

  /// Leaves the last sample of a plateau out of it where the way on is followed from sample to
  /// sample: until the next one, its speed may already change.
  void LeaveLastSamples() {
    for (size_t i = 0; i < plateaus_.size(); ++i) {
      Plateau& plateau = plateaus_[i];
      const bool is_followed = i < changes_.size() ? !changes_[i] : plateau.end < count_;
      if (is_followed && plateau.end - plateau.begin > 1) keep_[--plateau.end] = false;
    }
  }

  void TakeSpeed(const Plateau& plateau) {
    if (!plateau.line) return;
    for (Index i = plateau.begin; i < plateau.end; ++i) {
      const double since = time_[i] - plateau.line->time;
      velocity_[i] = plateau.moves ? plateau.line->velocity + plateau.drift * since : 0;
    }
  }

  /// The way from plateau i to the next.
  void TakeWay(size_t i) {
    const Index last = plateaus_[i + 1].begin;
    if (plateaus_[i].end == plateaus_[i].begin || last >= count_) return;
    if (changes_[i]) {
      FollowChange(*changes_[i], plateaus_[i].end - 1, last);
    } else {
      FollowSamples(plateaus_[i].end, last);
    }
  }

  void TakeWayBefore() {
    if (plateaus_.empty()) return FollowSamples(0, count_ - 1);
    if (plateaus_.front().begin > 0) FollowSamples(0, plateaus_.front().begin);
  }

  void TakeWayBehind() {
    if (!plateaus_.empty() && plateaus_.back().end < count_) {
      FollowSamples(plateaus_.back().end, count_ - 1);
    }
  }

  /// The speed from sample to sample, from `first` to `last`.
  void FollowSamples(Index first, Index last) {
    for (Index begin = first; begin < last;) {
      Index end = begin;
      while (end < last && time_[end + 1] - time_[end] <= longest_) ++end;
      if (end > begin) {
        const double hysteresis = kHysteresis * noise_.reach;
        const VectorXd path = MonotonePath(time_.segment(begin, end - begin + 1),
                                           position_.segment(begin, end - begin + 1), hysteresis);
        for (Index i = begin; i < end; ++i) {
          velocity_[i] = (path[i + 1 - begin] - path[i - begin]) / (time_[i + 1] - time_[i]);
        }
      }
      begin = end + 1;
    }
  }

  /// The speed along a change of speed, with samples put in where it is not even between two.
  void FollowChange(const SpeedChange& change, Index first, Index last) {
    std::vector<double> corners;
    const int pieces = change.duration > 0 ? kPiecesOfRamp : 1;
    for (int k = 0; k <= pieces; ++k) {
      corners.push_back(change.begin() + change.duration * k / pieces);
    }
    const double v0 = change.before.velocity, v1 = change.behind.velocity;
    if (v0 * v1 < 0) corners.push_back(change.begin() + change.duration * v0 / (v0 - v1));
    std::ranges::sort(corners);

    size_t next = 0;
    for (Index i = first; i < last; ++i) {
      const double h = time_[i + 1] - time_[i];
      double from = time_[i];
      Index at = -1;  // the sample put in last, in this step
      const auto hold = [&](double to) {
        const double speed = (change.At(to) - change.At(from)) / (to - from);
        (at < 0 ? velocity_[i] : inserted_[static_cast<size_t>(at)].velocity) = speed;
      };
      while (next < corners.size() && corners[next] <= time_[i] + kAtSample * h) ++next;
      for (; next < corners.size() && corners[next] < time_[i + 1] - kAtSample * h; ++next) {
        if (corners[next] - from <= kAtSample * h) continue;
        hold(corners[next]);
        from = corners[next];
        at = static_cast<Index>(inserted_.size());
        inserted_.push_back({first_ + i, from, log_.position[first_] + change.At(from), 0});
      }
      hold(time_[i + 1]);
    }
    CountUnseen(change, first, last);
  }

  /// The path that a ramp which no sample shows would not have travelled.
  void CountUnseen(const SpeedChange& change, Index first, Index last) {
    const double v0 = change.before.velocity, v1 = change.behind.velocity;
    if (change.duration > 0 || v0 * v1 >= 0) return;
    Index behind = first;
    while (behind < last && time_[behind] < change.time) ++behind;
    const double nearest =
        std::min(time_[behind] - change.time, change.time - time_[std::max(behind - 1, first)]);
    unseen_ += 2 * std::max(nearest, 0.0) * std::abs(v0 * v1 / (v0 - v1));
  }

  const Measurements& log_;
  Index first_, count_;
  VectorXd time_, position_, velocity_;
  Eigen::Array<bool, Eigen::Dynamic, 1> keep_;
  double longest_ = 0;  // s
  PositionNoise noise_;
  std::vector<Plateau> plateaus_;
  std::vector<std::optional<SpeedChange>> changes_;  // behind each plateau but the last
  std::vector<InsertedSample> inserted_;
  double unseen_ = 0;  // rad or m
};

}  // namespace

PositionMotion MotionFromPositions(const Measurements& measurements, const Selection& selection,
                                   const std::vector<Segment>& rests) {
  PositionMotion motion{measurements, {selection.keep, {}}, 0};
  std::vector<InsertedSample> inserted;
  double unseen = 0;
  for (const auto& [first, count] : RecordingsOf(measurements)) {
    RecordingMotion one(measurements, selection, rests, {first, count});
    one.Solve();
    motion.measurements.velocity.segment(first, count) = one.velocity();
    motion.selection.keep.segment(first, count) = one.keep();
    one.AddSegments(motion.selection.segments);
    inserted.insert(inserted.end(), one.inserted().begin(), one.inserted().end());
    unseen += one.unseen();
  }
  InsertSamples(inserted, motion.measurements, motion.selection);

  const Measurements& m = motion.measurements;
  const Index steps = m.size() - 1;
  const double path =
      m.velocity.head(steps).cwiseAbs().dot(m.time.tail(steps) - m.time.head(steps));
  motion.unseen = path > 0 ? unseen / path : 0;
  return motion;
}

}  // namespace warmjoint::inline identification
