#include "identification/preparation/motion_from_positions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "identification/preparation/position_noise.h"
#include "identification/preparation/position_plateaus.h"
#include "models/foundation/low_pass.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kPiecesOfRamp = 8;    // in which its speed is held
constexpr double kHysteresis = 6;   // reaches
constexpr double kAtSample = 1e-6;  // of a step: nearer to a sample is at it

// DeriveVelocity: the smoothed slope.

/// Central differences, one-sided at the ends.
VectorXd Differences(const VectorXd& time, const VectorXd& x) {
  const Index n = x.size();
  VectorXd slope(n);
  slope.segment(1, n - 2) =
      (x.tail(n - 2) - x.head(n - 2)).cwiseQuotient(time.tail(n - 2) - time.head(n - 2));
  slope[0] = (x[1] - x[0]) / (time[1] - time[0]);
  slope[n - 1] = (x[n - 1] - x[n - 2]) / (time[n - 1] - time[n - 2]);
  return slope;
}

/// y at the times t, by straight lines between its samples at `time`; both increase, and t lies
/// within `time`.
VectorXd Interpolate(const VectorXd& time, const VectorXd& y, const VectorXd& t) {
  VectorXd result(t.size());
  for (Index i = 0, k = 0; i < t.size(); ++i) {
    while (k + 2 < time.size() && time[k + 1] < t[i]) ++k;
    const double share = (t[i] - time[k]) / (time[k + 1] - time[k]);
    result[i] = y[k] + share * (y[k + 1] - y[k]);
  }
  return result;
}

/// Velocity of a piece without gaps.
VectorXd DerivePiece(const VectorXd& time, const VectorXd& position, double cutoff) {
  const Index n = time.size();
  // too few samples for a filter: one slope
  if (n < 3) {
    const double moved = position[n - 1] - position[0];
    return VectorXd::Constant(n, n == 1 ? 0 : moved / (time[1] - time[0]));
  }
  const double rate = static_cast<double>(n - 1) / (time[n - 1] - time[0]);
  // a cutoff near half the rate filters nothing
  if (cutoff > 0.4 * rate) return Differences(time, position);

  // evenly sampled positions are filtered as they are, others on an even grid and back
  const std::vector<Biquad> filter = ButterworthLowPass(4, cutoff, rate);
  const VectorXd steps = time.tail(n - 1) - time.head(n - 1);
  if ((steps.array() * rate - 1).abs().maxCoeff() <= 0.01) {
    return Differences(time, FilterZeroPhase(filter, position));
  }
  const VectorXd even = VectorXd::LinSpaced(n, time[0], time[n - 1]);
  const VectorXd smooth = FilterZeroPhase(filter, Interpolate(time, position, even));
  return Interpolate(even, Differences(even, smooth), time);
}

// MotionFromPositions: one speed for each segment, and the path between them.

/// First and last sample and the turning points between them, ascending: a turning point is the
/// furthest sample before it leads back by more than the hysteresis.
std::vector<Index> TurningPoints(const VectorXd& p, double hysteresis) {
  std::vector<Index> turns{0};
  Index high = 0, low = 0;
  int direction = 0;
  for (Index i = 1; i < p.size(); ++i) {
    // the extremes since the last turning point
    if (p[i] > p[high]) high = i;
    if (p[i] < p[low]) low = i;
    // a path back by more than the hysteresis shows that the extreme before it was a turn
    if (direction >= 0 && p[high] - p[i] > hysteresis) {
      if (direction > 0 || high > 0) turns.push_back(high);
      direction = -1;
      low = high = i;
    } else if (direction <= 0 && p[i] - p[low] > hysteresis) {
      if (direction < 0 || low > 0) turns.push_back(low);
      direction = 1;
      low = high = i;
    }
  }
  // the last sample ends the last stretch
  if (turns.back() != p.size() - 1) turns.push_back(p.size() - 1);
  return turns;
}

/// A run of samples that share one value.
struct Pool {
  double times = 0, values = 0;  // sums
  double count = 0;

  double Middle() const { return times / count; }
  double Mean() const { return values / count; }
  void Add(const Pool& other) {
    times += other.times;
    values += other.values;
    count += other.count;
  }
};

/// Replaces samples first, ..., last: the nearest sequence that rises (sign 1) or falls (-1) is one
/// of runs of equal values; straight lines lead from the middle of each run to that of the next.
void MakeMonotone(const VectorXd& time, VectorXd& p, Index first, Index last, double sign) {
  std::vector<Pool> pools;
  for (Index i = first; i <= last; ++i) {
    pools.push_back({time[i], sign * p[i], 1});
    // neighbours in the wrong order become one run of their mean
    while (pools.size() > 1 && pools[pools.size() - 2].Mean() >= pools.back().Mean()) {
      const Pool behind = pools.back();
      pools.pop_back();
      pools.back().Add(behind);
    }
  }
  // straight lines between the middles of the runs, level before the first and after the last
  size_t k = 0;
  for (Index i = first; i <= last; ++i) {
    while (k + 1 < pools.size() && pools[k + 1].Middle() <= time[i]) ++k;
    const double from = pools[k].Middle();
    double value = pools[k].Mean();
    // between two runs by the share of the time that has passed
    if (k + 1 < pools.size() && time[i] > from) {
      const double share = (time[i] - from) / (pools[k + 1].Middle() - from);
      value += share * (pools[k + 1].Mean() - value);
    }
    p[i] = sign * value;
  }
}

/// Follows the positions from plateau to plateau.
class MotionBuilder {
 public:
  MotionBuilder(const Measurements& log, PositionPlateaus found)
      : time_(log.time),
        position_(log.position),
        found_(std::move(found)),
        velocity_(log.velocity) {
    const std::vector<Plateau>& plateaus = found_.plateaus;
    for (const Plateau& plateau : plateaus) TakeSpeed(plateau);
    // before, between and after the plateaus; or along all of a log that has none
    const Index last = time_.size() - 1;
    FollowSamples(0, plateaus.empty() ? last : plateaus.front().begin);
    for (size_t i = 0; i + 1 < plateaus.size(); ++i) FollowTransition(i);
    FollowSamples(plateaus.empty() ? last : plateaus.back().end, last);
  }

  FilledLog Fill(Measurements log) && {
    log.velocity = std::move(velocity_);
    FilledLog motion{{LogSamples(std::move(log)), {std::move(found_.keep), {}}}, 0};
    // the segments with the samples that they reached
    for (const Plateau& plateau : found_.plateaus) {
      if (!plateau.moves || plateau.end <= plateau.begin) continue;
      const VectorXd& velocity = motion.view.measurements.velocity;
      const double speed = plateau.line ? plateau.line->slope : velocity[plateau.begin];
      motion.view.selection.segments.push_back({plateau.begin, plateau.end, speed});
    }
    InsertSamples(inserted_, motion.view);
    const double path = HeldPath(motion.view.measurements);
    motion.unresolved_path = path > 0 ? unresolved_ / path : 0;
    motion.position_deviation = found_.noise.deviation;
    return motion;
  }

 private:
  void TakeSpeed(const Plateau& plateau) {
    if (!plateau.line) return;
    for (Index i = plateau.begin; i < plateau.end; ++i) {
      const double since = time_[i] - plateau.line->time;
      velocity_[i] = plateau.moves ? plateau.line->slope + plateau.drift * since : 0;
    }
  }

  /// The transition from plateau i to the next.
  void FollowTransition(size_t i) {
    const Index last = found_.plateaus[i + 1].begin;
    if (found_.plateaus[i].end == found_.plateaus[i].begin || last >= time_.size()) return;
    if (found_.changes[i]) {
      FollowChange(*found_.changes[i], found_.plateaus[i].end - 1, last);
    } else {
      FollowSamples(found_.plateaus[i].end, last);
    }
  }

  /// The speed from sample to sample, from `first` to `last`.
  void FollowSamples(Index first, Index last) {
    for (Index begin = first; begin < last;) {
      // up to the next gap
      const Index end = std::min(PieceAt(found_.pieces, begin).end() - 1, last);
      if (end > begin) {
        // noise moves the path back and forth, the joint does not
        const double hysteresis = kHysteresis * found_.noise.reach;
        const VectorXd path =
            MonotonePath(time_.segment(begin, end - begin + 1),
                         found_.position.segment(begin, end - begin + 1), hysteresis);
        for (Index i = begin; i < end; ++i) {
          velocity_[i] = (path[i + 1 - begin] - path[i - begin]) / (time_[i + 1] - time_[i]);
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
    const double v0 = change.before.slope, v1 = change.behind.slope;
    if (v0 * v1 < 0) corners.push_back(change.begin() + change.duration * v0 / (v0 - v1));
    std::ranges::sort(corners);

    size_t next = 0;
    // one speed for each step, or for each of its parts where corners lie within it
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
        inserted_.push_back({i, from, position_[0] + change.At(from), 0});
      }
      hold(time_[i + 1]);
    }
    CountUnresolved(change, first, last);
  }

  /// The path that a ramp which no sample shows would not have travelled.
  void CountUnresolved(const SpeedChange& change, Index first, Index last) {
    if (change.duration > 0) return;
    Index behind = first;
    while (behind < last && time_[behind] < change.time) ++behind;
    const double nearest =
        std::min(time_[behind] - change.time, change.time - time_[std::max(behind - 1, first)]);
    unresolved_ += UnresolvedAt(change.before.slope, change.behind.slope, std::max(nearest, 0.0));
  }

  const VectorXd& time_;      // [N] s
  const VectorXd& position_;  // [N] rad or m
  PositionPlateaus found_;
  VectorXd velocity_;  // [N] rad/s or m/s
  std::vector<InsertedSample> inserted_;
  double unresolved_ = 0;  // rad or m
};

}  // namespace

VectorXd DeriveVelocity(const VectorXd& time, const VectorXd& position, double cutoff) {
  // piece by piece: nothing is known of the motion in a gap
  VectorXd velocity(time.size());
  for (const auto& [first, count] : PiecesOf(time)) {
    velocity.segment(first, count) =
        DerivePiece(time.segment(first, count), position.segment(first, count), cutoff);
  }
  return velocity;
}

double ChooseCutoff(const VectorXd& time, const VectorXd& position) {
  constexpr double highest = 100;  // Hz
  constexpr double lowest = 0.02;  // of the sampling rate
  constexpr double accepted_noise =
      0.01;  // of the velocity's rms; why: it takes 0.01^2 off a slope
  const double rate = 1 / MedianStep(time);

  // slope over a fiftieth of a second or one step, so that noise hardly enters the scale
  const Index n = position.size();
  const auto lag = std::clamp<Index>(static_cast<Index>(rate / 50), 1, n - 1);
  const VectorXd slope =
      (position.tail(n - lag) - position.head(n - lag)) * (rate / static_cast<double>(lag));
  const double speed = std::sqrt(slope.squaredNorm() / static_cast<double>(slope.size()));

  // white noise, or the rounding to steps of the encoder
  const double noise = std::max(WhiteNoise(position), StepOfPosition(position) / std::sqrt(12.0));
  if (noise == 0) return highest;
  // below a cutoff f white noise leaves the velocity a variance of (2 pi noise)^2 2 f^3 / (3 rate)
  const double ratio = accepted_noise * speed / (2 * std::numbers::pi * noise);
  const double cutoff = std::cbrt(1.5 * ratio * ratio * rate);
  return std::clamp(cutoff, std::min(lowest * rate, highest), highest);
}

FilledLog MotionFromPositions(const Measurements& measurements, const ConstantSpeed& found) {
  return MotionBuilder(measurements, FindPlateaus(measurements, found)).Fill(measurements);
}

VectorXd MonotonePath(const VectorXd& time, const VectorXd& position, double hysteresis) {
  VectorXd path = position;
  const std::vector<Index> turns = TurningPoints(position, hysteresis);
  for (size_t k = 1; k < turns.size(); ++k) {
    // a turning point belongs to the stretch that leads to it
    const Index first = k == 1 ? turns[0] : turns[k - 1] + 1;
    const double sign = position[turns[k]] >= position[turns[k - 1]] ? 1 : -1;
    MakeMonotone(time, path, first, turns[k], sign);
  }
  return path;
}

}  // namespace warmjoint
