#include "identification/preparation/motion_from_positions.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "identification/preparation/insert_samples.h"
#include "identification/preparation/monotone_path.h"
#include "identification/preparation/position_plateaus.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kPiecesOfRamp = 8;    // in which its speed is held
constexpr double kHysteresis = 6;   // reaches
constexpr double kAtSample = 1e-6;  // of a step: nearer to a sample is at it

/// The motion along one recording of the log.
class RecordingMotion {
 public:
  RecordingMotion(const Measurements& log, PositionPlateaus found, SampleRange range)
      : log_(log),
        first_(range.first),
        count_(range.count),
        found_(std::move(found)),
        velocity_(log.velocity.segment(first_, count_)) {
    for (const Plateau& plateau : found_.plateaus) TakeSpeed(plateau);
    TakeWayBefore();
    for (size_t i = 0; i + 1 < found_.plateaus.size(); ++i) TakeWay(i);
    TakeWayBehind();
  }

  const VectorXd& velocity() const { return velocity_; }
  const Eigen::Array<bool, Eigen::Dynamic, 1>& keep() const { return found_.keep; }
  const std::vector<InsertedSample>& inserted() const { return inserted_; }
  double unseen() const { return unseen_; }

  /// The segments with the samples that they reached.
  void AddSegments(std::vector<Segment>& segments) const {
    for (const Plateau& plateau : found_.plateaus) {
      if (!plateau.moves || plateau.end <= plateau.begin) continue;
      const double speed = plateau.line ? plateau.line->velocity : velocity_[plateau.begin];
      segments.push_back({first_ + plateau.begin, first_ + plateau.end, speed});
    }
  }

 private:
  void TakeSpeed(const Plateau& plateau) {
    if (!plateau.line) return;
    for (Index i = plateau.begin; i < plateau.end; ++i) {
      const double since = found_.time[i] - plateau.line->time;
      velocity_[i] = plateau.moves ? plateau.line->velocity + plateau.drift * since : 0;
    }
  }

  /// The way from plateau i to the next.
  void TakeWay(size_t i) {
    const Index last = found_.plateaus[i + 1].begin;
    if (found_.plateaus[i].end == found_.plateaus[i].begin || last >= count_) return;
    if (found_.changes[i]) {
      FollowChange(*found_.changes[i], found_.plateaus[i].end - 1, last);
    } else {
      FollowSamples(found_.plateaus[i].end, last);
    }
  }

  void TakeWayBefore() {
    if (found_.plateaus.empty()) return FollowSamples(0, count_ - 1);
    if (found_.plateaus.front().begin > 0) FollowSamples(0, found_.plateaus.front().begin);
  }

  void TakeWayBehind() {
    if (!found_.plateaus.empty() && found_.plateaus.back().end < count_) {
      FollowSamples(found_.plateaus.back().end, count_ - 1);
    }
  }

  /// The speed from sample to sample, from `first` to `last`.
  void FollowSamples(Index first, Index last) {
    for (Index begin = first; begin < last;) {
      // one piece without gaps
      Index end = begin;
      while (end < last && found_.time[end + 1] - found_.time[end] <= found_.longest) ++end;
      if (end > begin) {
        // noise moves the path back and forth, the joint does not
        const double hysteresis = kHysteresis * found_.noise.reach;
        const VectorXd path =
            MonotonePath(found_.time.segment(begin, end - begin + 1),
                         found_.position.segment(begin, end - begin + 1), hysteresis);
        for (Index i = begin; i < end; ++i) {
          velocity_[i] =
              (path[i + 1 - begin] - path[i - begin]) / (found_.time[i + 1] - found_.time[i]);
        }
      }
      begin = end + 1;
    }
  }

  /// The speed along a change of speed, with samples put in where it is not even between two.
  void FollowChange(const SpeedChange& change, Index first, Index last) {
    // corners of the ramp, and where it reverses
    std::vector<double> corners;
    const int pieces = change.duration > 0 ? kPiecesOfRamp : 1;
    for (int k = 0; k <= pieces; ++k) {
      corners.push_back(change.begin() + change.duration * k / pieces);
    }
    const double v0 = change.before.velocity, v1 = change.behind.velocity;
    if (v0 * v1 < 0) corners.push_back(change.begin() + change.duration * v0 / (v0 - v1));
    std::ranges::sort(corners);

    size_t next = 0;
    // one speed for each step, or for each of its parts where corners lie within it
    for (Index i = first; i < last; ++i) {
      const double h = found_.time[i + 1] - found_.time[i];
      double from = found_.time[i];
      Index at = -1;  // the sample put in last, in this step
      const auto hold = [&](double to) {
        const double speed = (change.At(to) - change.At(from)) / (to - from);
        (at < 0 ? velocity_[i] : inserted_[static_cast<size_t>(at)].velocity) = speed;
      };
      while (next < corners.size() && corners[next] <= found_.time[i] + kAtSample * h) ++next;
      for (; next < corners.size() && corners[next] < found_.time[i + 1] - kAtSample * h; ++next) {
        if (corners[next] - from <= kAtSample * h) continue;
        hold(corners[next]);
        from = corners[next];
        at = static_cast<Index>(inserted_.size());
        inserted_.push_back({first_ + i, from, log_.position[first_] + change.At(from), 0});
      }
      hold(found_.time[i + 1]);
    }
    CountUnseen(change, first, last);
  }

  /// The path that a ramp which no sample shows would not have travelled.
  void CountUnseen(const SpeedChange& change, Index first, Index last) {
    const double v0 = change.before.velocity, v1 = change.behind.velocity;
    if (change.duration > 0 || v0 * v1 >= 0) return;
    // a ramp without samples reaches to the nearer sample at most
    Index behind = first;
    while (behind < last && found_.time[behind] < change.time) ++behind;
    const double nearest = std::min(found_.time[behind] - change.time,
                                    change.time - found_.time[std::max(behind - 1, first)]);
    unseen_ += 2 * std::max(nearest, 0.0) * std::abs(v0 * v1 / (v0 - v1));
  }

  const Measurements& log_;
  Index first_, count_;
  PositionPlateaus found_;
  VectorXd velocity_;  // [n]
  std::vector<InsertedSample> inserted_;
  double unseen_ = 0;  // rad or m
};

}  // namespace

PositionMotion MotionFromPositions(const Measurements& measurements, const Selection& selection,
                                   const std::vector<Segment>& rests) {
  PositionMotion motion{measurements, {selection.keep, {}}, 0};
  std::vector<InsertedSample> inserted;
  double unseen = 0;
  // each recording on its own: its plateaus, the ways between them, and the samples put in
  for (const auto& [first, count] : RecordingsOf(measurements)) {
    const SampleRange range{first, count};
    const RecordingMotion one(measurements, FindPlateaus(measurements, selection, rests, range),
                              range);
    motion.measurements.velocity.segment(first, count) = one.velocity();
    motion.selection.keep.segment(first, count) = one.keep();
    one.AddSegments(motion.selection.segments);
    inserted.insert(inserted.end(), one.inserted().begin(), one.inserted().end());
    unseen += one.unseen();
  }
  InsertSamples(inserted, motion.measurements, motion.selection);

  const Measurements& m = motion.measurements;
  const Index steps = m.size() - 1;
  // the part that a drive may not have travelled, as a share of the whole path
  const double path =
      m.velocity.head(steps).cwiseAbs().dot(m.time.tail(steps) - m.time.head(steps));
  motion.unseen = path > 0 ? unseen / path : 0;
  return motion;
}

}  // namespace warmjoint
