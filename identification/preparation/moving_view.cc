#include "identification/preparation/moving_view.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "identification/preparation/column_lag.h"
#include "identification/preparation/local_motion.h"
#include "identification/preparation/position_noise.h"
#include "models/foundation/robust_noise.h"
#include "models/friction/sign.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kDeviations = 5;  // of the noise; why 5: by chance 1 in 2 million
constexpr Index kReach = 2;        // samples to each side of a difference; why 2: fourth order
constexpr double kGain =
    0.9501;  // why: sqrt(2 (1 + 8^2)) / 12, noise of a difference times the step, of even samples

constexpr double kContradicts = 2;  // path by positions over that by velocities, or the inverse

constexpr double kSomeHeld =
    0.1;  // of the samples in motion; why: of a sine less than a hundredth looks like a hold
constexpr double kUnresolvedTurns =
    5e-3;  // of the path; why: a warming may have an error of that size before a warning is given
constexpr double kHeld =
    0.5;  // of the samples in motion; why: fewer held samples, peaks among them, show less than the other samples
constexpr double kDrifts = 0.5;    // why: most of what the speed does is then an acceleration
constexpr double kFollowed = 0.5;  // why: of half the samples deviations are 1.4 times as large

double RootMeanSquare(const VectorXd& x) {
  return x.size() == 0 ? 0 : std::sqrt(x.squaredNorm() / static_cast<double>(x.size()));
}

/// Slope at `time[at]` of the polynomial through all values: the derivatives of Lagrange's polynomials there.
double SlopeThrough(const Eigen::Ref<const VectorXd>& time,
                    const Eigen::Ref<const VectorXd>& values, Index at) {
  double slope = 0;
  for (Index j = 0; j < time.size(); ++j) {
    if (j == at) continue;
    // slope of the polynomial that is 1 at sample j and 0 at the others
    double share = 1 / (time[j] - time[at]);
    for (Index k = 0; k < time.size(); ++k) {
      if (k != j && k != at) share *= (time[at] - time[k]) / (time[j] - time[k]);
    }
    slope += share * (values[j] - values[at]);
  }
  return slope;
}

/// Differences of fourth order, through two samples on each side, less near the ends of pieces: of
/// second order, the motion's third derivative would be part of the acceleration, which after a
/// reversal acts like friction. [N] rad/s^2 or m/s^2
VectorXd Differences(const Measurements& m, const std::vector<SampleRange>& pieces) {
  VectorXd slopes = VectorXd::Zero(m.size());
  for (const auto& [first, count] : pieces) {
    for (Index i = first; i < first + count; ++i) {
      // as many samples on each side as the piece has, up to kReach
      const Index reach = std::min({kReach, i - first, first + count - 1 - i});
      const Index begin = std::max(first, i - std::max<Index>(reach, 1));
      const Index end = std::min(first + count, i + std::max<Index>(reach, 1) + 1);
      slopes[i] = SlopeThrough(m.time.segment(begin, end - begin),
                               m.velocity.segment(begin, end - begin), i - begin);
    }
  }
  return slopes;
}

/// How much the acceleration differs from one side of each sample to the other; 0 at the ends of
/// pieces. [N]
VectorXd Jumps(const Measurements& m, const std::vector<SampleRange>& pieces) {
  VectorXd jumps = VectorXd::Zero(m.size());
  // slopes on both sides of each sample
  for (const auto& [first, count] : pieces) {
    for (Index i = first + 1; i + 1 < first + count; ++i) {
      const double before = (m.velocity[i] - m.velocity[i - 1]) / (m.time[i] - m.time[i - 1]);
      const double behind = (m.velocity[i + 1] - m.velocity[i]) / (m.time[i + 1] - m.time[i]);
      jumps[i] = std::abs(behind - before);
    }
  }
  return jumps;
}

/// The motion by differences, where noise leaves them kAcceptedNoise of their root mean square
/// or less; samples at which they jump are not known. Nothing where noise leaves more.
std::optional<LocalMotion> ByDifferences(const Measurements& m,
                                         const std::vector<SampleRange>& pieces) {
  LocalMotion motion{m.velocity, Differences(m, pieces), {}};
  // noise of the acceleration, compared with the part of its rms that is motion
  const SampleMask moving = InMotion(m.velocity);
  const double noise = NoiseOfVelocity(m.velocity), step = MedianStep(m.time);
  const double left = kGain * noise / step,
               rms = RootMeanSquare(Chosen(motion.acceleration, moving));
  if (left * left > kAcceptedNoise * kAcceptedNoise * (rms * rms - left * left)) {
    return std::nullopt;
  }
  // the motion at samples next to a jump of the acceleration is not known
  motion.known = AwayFromCorners(SampleMask::Constant(m.size(), true), Jumps(m, pieces), moving,
                                 rms, noise * std::sqrt(6.0) / step);
  return motion;
}

/// Mean of |v| along a straight line between two velocities, which may pass 0.
double MeanSpeed(double from, double to) {
  const double a = std::abs(from), b = std::abs(to);
  return from * to < 0 ? (a * a + b * b) / (2 * (a + b)) : (a + b) / 2;
}

/// Computes, for a velocity that is a straight line from sample i to the next, the mean of |v|, and the mean of v^2 over
/// that of |v|. Where the velocity changes its sign, both sides of the turn count.
void TakeLine(const VectorXd& velocity, Index i, BetweenSamples& between) {
  const double from = velocity[i], to = velocity[i + 1];
  const double a = std::abs(from), b = std::abs(to);
  const bool turns = from * to < 0;
  const double speed = MeanSpeed(from, to);
  const double square = turns ? (a * a - a * b + b * b) / 3 : (a * a + a * b + b * b) / 3;
  between.mean_speed[i] = speed;
  between.loss_velocity[i] = speed > 0 ? Sign(from) * square / speed : from;
}

/// The path from sample `first` to sample `last` by the mean speeds, rad or m.
double PathOf(const VectorXd& time, const VectorXd& speed, Index first, Index last) {
  double path = 0;
  for (Index i = first; i < last; ++i) path += speed[i] * (time[i + 1] - time[i]);
  return path;
}

/// Scales the speeds of a stretch in one direction to the path of its positions.
void FollowPositions(const Measurements& m, Index first, Index last, BetweenSamples& between) {
  const double by_velocity = PathOf(m.time, between.mean_speed, first, last);
  const double by_position = std::abs(m.position[last] - m.position[first]);
  const double ratio = by_position / by_velocity;
  if (!(ratio < kContradicts && ratio > 1 / kContradicts)) return;
  between.mean_speed.segment(first, last - first) *= ratio;
  between.loss_velocity.segment(first, last - first) *= ratio;
}

/// The same for each stretch of a piece in which the joint clearly moves in one direction.
void FollowPositions(const Measurements& m, const SampleRange& piece, double clear,
                     BetweenSamples& between) {
  const Index end = piece.first + piece.count;
  for (Index i = piece.first; i < end; ++i) {
    if (!(std::abs(m.velocity[i]) > clear)) continue;
    // the longest stretch that keeps its direction and stays clearly away from rest
    const Index first = i;
    while (i + 1 < end && std::abs(m.velocity[i + 1]) > clear &&
           m.velocity[i + 1] * m.velocity[first] > 0) {
      ++i;
    }
    if (i > first) FollowPositions(m, first, i, between);
  }
}

/// Adds the path between a sample at rest and the next one to that of the next one.
void PassRest(const Measurements& m, const SampleRange& piece, VectorXd& speed) {
  for (Index i = piece.first; i + 2 < piece.first + piece.count; ++i) {
    if (m.velocity[i] != 0) continue;
    const double path = speed[i] * (m.time[i + 1] - m.time[i]);
    speed[i] = 0;
    if (m.velocity[i + 1] != 0) speed[i + 1] += path / (m.time[i + 2] - m.time[i + 1]);
  }
}

/// Segments of a selection whose positions change by less than half, or by more than one and a half times, of the path by their
/// speed: rests of a column with an offset, and creeping.
std::vector<Segment> ContradictedSegments(const Measurements& m, const Selection& selection) {
  std::vector<Segment> contradicted;
  if (m.position_integrated || m.position.size() != m.size()) return contradicted;
  const auto off = [&](const Segment& one) {
    const double moves = one.velocity * (m.time[one.end - 1] - m.time[one.begin]);
    const double moved = m.position[one.end - 1] - m.position[one.begin];
    return std::abs(moved - moves) - 0.5 * std::abs(moves);
  };
  std::ranges::copy_if(selection.segments, std::back_inserter(contradicted),
                       [&](const Segment& one) { return off(one) > 0; });
  if (contradicted.empty()) return contradicted;
  // by more than noise and steps of the positions
  const double reach = 2 * MeasurePositionNoise(m.position).reach;
  std::erase_if(contradicted, [&](const Segment& one) { return off(one) <= reach; });
  return contradicted;
}

/// The share of the changes of speed within segments that is a drift from one end to the other, beyond that of white noise: near
/// 0 where speeds are held, with whatever ripple, and near 1 where pieces of a smooth motion pass for holds.
double DriftWithin(const Measurements& m, const std::vector<Segment>& segments) {
  double drift = 0, all = 0;
  for (const Segment& one : segments) {
    const Index n = one.end - one.begin;
    if (n < 3) continue;
    const Eigen::ArrayXd t =
        m.time.segment(one.begin, n).array() - m.time.segment(one.begin, n).mean();
    const Eigen::ArrayXd v =
        m.velocity.segment(one.begin, n).array() - m.velocity.segment(one.begin, n).mean();
    const double squares = v.square().sum(), along = std::pow((t * v).sum(), 2) / t.square().sum();
    drift += along - (squares - along) / static_cast<double>(n - 2);
    all += squares;
  }
  return all > 0 ? drift / all : 0;
}

}  // namespace

BetweenSamples MeansBetween(const Measurements& m, const std::vector<SampleRange>& pieces,
                            double clear) {
  BetweenSamples between{m.velocity.cwiseAbs(), m.velocity};
  const bool has_positions = m.position.size() == m.size() && m.position.allFinite();
  // straight lines between the velocities, scaled to the path of the positions; the paths next to rests come last
  for (const SampleRange& piece : pieces) {
    for (Index i = piece.first; i + 1 < piece.first + piece.count; ++i) {
      TakeLine(m.velocity, i, between);
    }
    if (has_positions) FollowPositions(m, piece, clear, between);
    PassRest(m, piece, between.mean_speed);
  }
  return between;
}

double ClearSpeed(const Measurements& m) {
  const SampleMask moving = InMotion(m.velocity);
  const double noise = WhiteNoise(m.velocity, moving), resolution = StepOfVelocity(m.velocity);
  return std::max(
      {kClear * RootMeanSquare(Chosen(m.velocity, moving)), kDeviations * noise, 1.5 * resolution});
}

namespace {

/// The motion by differences where noise allows them, else by polynomials over as many samples as are needed.
LocalMotion MotionOf(const Measurements& m, const std::vector<SampleRange>& pieces,
                     MotionSource source) {
  std::optional<LocalMotion> motion;
  if (source == MotionSource::velocity) motion = ByDifferences(m, pieces);
  return motion ? *std::move(motion) : FollowLocally(m, pieces, source);
}

/// The path from sample i to sample j, where the joint turns, if it keeps its speeds up to the turn, less the path by straight
/// lines between the velocities, rad or m.
double HiddenPath(const Measurements& m, const VectorXd& velocity, Index i, Index j) {
  double lines = 0, moved = 0;
  for (Index k = i; k < j; ++k) {
    const double step = m.time[k + 1] - m.time[k];
    lines += step * MeanSpeed(velocity[k], velocity[k + 1]);
    moved += step * (velocity[k] + velocity[k + 1]) / 2;
  }
  // the turn lies where both speeds together give the way between the samples
  const double span = m.time[j] - m.time[i], from = velocity[i], to = velocity[j];
  const double turn = std::clamp((moved - to * span) / (from - to), 0.0, span);
  return std::max(std::abs(from) * turn + std::abs(to) * (span - turn) - lines, 0.0);
}

/// Share of a log's path that is hidden in that way at turns which no polynomial follows.
double UnresolvedTurns(const Measurements& m, MotionSource source) {
  const std::vector<SampleRange> pieces = PiecesOf(m.time);
  const LocalMotion motion = MotionOf(m, pieces, source);
  double path = 0, hidden = 0;
  for (const SampleRange& piece : pieces) {
    Index before = -1;  // the last sample whose motion is known
    for (Index i = piece.first; i < piece.end(); ++i) {
      if (i + 1 < piece.end()) {
        path += (m.time[i + 1] - m.time[i]) * MeanSpeed(motion.velocity[i], motion.velocity[i + 1]);
      }
      if (!motion.known[i]) continue;
      const bool turns = before >= 0 && motion.velocity[before] * motion.velocity[i] < 0;
      if (turns && before + 1 < i) hidden += HiddenPath(m, motion.velocity, before, i);
      before = i;
    }
  }
  return path > 0 ? hidden / path : 0;
}

}  // namespace

LogView ViewMotion(const Measurements& measurements, MotionSource source) {
  LogView view{LogSamples(measurements), {}};
  LogSamples& m = view.measurements;
  const std::vector<SampleRange> pieces = PiecesOf(m.time);
  const double clear = ClearSpeed(m);
  LocalMotion motion = MotionOf(m, pieces, source);
  m.velocity = std::move(motion.velocity);
  m.acceleration = std::move(motion.acceleration);
  // mean speeds and losses between the samples
  const BetweenSamples between = MeansBetween(m, pieces, clear);
  m.mean_speed = between.mean_speed;
  m.loss_velocity = between.loss_velocity;

  // samples at which the joint clearly moves, between neighbours that move in the same direction
  auto& keep = view.selection.keep;
  keep = motion.known && m.velocity.array().abs() > clear;
  for (const auto& [first, count] : pieces) {
    for (Index i = first; i < first + count; ++i) {
      const Index before = std::max(first, i - 1), behind = std::min(first + count - 1, i + 1);
      keep[i] = keep[i] && m.velocity[before] * m.velocity[i] > 0 &&
                m.velocity[behind] * m.velocity[i] > 0;
    }
  }
  return view;
}

bool HoldsSpeeds(const Measurements& m, const Selection& selection, MotionSource source) {
  const SampleMask moving = m.velocity.array().abs() > ClearSpeed(m);
  SampleMask held = selection.keep && moving;
  for (const Segment& one : ContradictedSegments(m, selection)) {
    held.segment(one.begin, one.end - one.begin) = false;
  }
  const auto all = static_cast<double>(moving.count()), count = static_cast<double>(held.count());
  if (count >= kHeld * all) return all == 0 || DriftWithin(m, selection.segments) < kDrifts;
  // holds lost in noise, with jumps from one speed to the next that motion of any kind cannot follow
  return count >= kSomeHeld * all && UnresolvedTurns(m, source) >= kUnresolvedTurns;
}

FollowedMotion FollowMotion(const Measurements& m, MotionSource source) {
  FollowedMotion followed{ViewMotion(m, source), {}};
  if (source == MotionSource::positions || m.position_integrated) return followed;
  const auto column = CompareColumn(m);
  if (!column || !(column->IsLate() || column->IsOff())) return followed;
  // without the offset the samples in motion can be seen
  Measurements still = m;
  if (column->IsOff()) still.velocity.array() -= column->offset;
  // coarse positions show little of the acceleration, and leave few of the samples in motion
  LogView by_positions = ViewMotion(still, MotionSource::positions);
  const auto moving = static_cast<double>(
      (by_positions.measurements.velocity.array().abs() > ClearSpeed(still)).count());
  if (static_cast<double>(by_positions.selection.count()) < kFollowed * moving) return followed;
  return {std::move(by_positions), Describe(*column, m.joint)};
}

}  // namespace warmjoint
