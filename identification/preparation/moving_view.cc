#include "identification/preparation/moving_view.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "identification/preparation/between_samples.h"
#include "identification/preparation/local_motion.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/measurements.h"
#include "models/recording/sampling.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kDeviations = 5;  // of the noise; why 5: by chance 1 in 2 million
constexpr Index kReach = 2;        // samples to each side of a difference; why 2: fourth order
constexpr double kGain =
    0.9501;  // why: sqrt(2 (1 + 8^2)) / 12, noise of a difference times the step, of even samples

double RootMeanSquare(const VectorXd& x) {
  return x.size() == 0 ? 0 : std::sqrt(x.squaredNorm() / static_cast<double>(x.size()));
}

/// Pieces without gaps, each of one recording.
std::vector<SampleRange> PiecesOf(const Measurements& m) {
  std::vector<SampleRange> pieces;
  for (const auto& [first, count] : RecordingsOf(m)) {
    const double longest = count < 2 ? 0 : LongestStep(m.time.segment(first, count));  // s
    Index begin = first;
    for (Index i = first + 1; i <= first + count; ++i) {
      // a piece goes on until a gap or the end of the recording
      if (i < first + count && m.time[i] - m.time[i - 1] <= longest) continue;
      pieces.push_back({begin, i - begin});
      begin = i;
    }
  }
  return pieces;
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
/// second order, the motion's third derivative would stand in the acceleration, which after a
/// reversal pushes as friction does. [N] rad/s^2 or m/s^2
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
  // noise of the acceleration, against what of its rms is motion
  const SampleMask moving = InMotion(m.velocity);
  const double noise = NoiseOfVelocity(m.velocity), step = MedianStep(m.time);
  const double left = kGain * noise / step,
               rms = RootMeanSquare(Chosen(motion.acceleration, moving));
  if (left * left > kAcceptedNoise * kAcceptedNoise * (rms * rms - left * left)) {
    return std::nullopt;
  }
  // samples beside a jump of the acceleration are not known
  motion.known = AwayFromCorners(KnownSamples::Constant(m.size(), true), Jumps(m, pieces), moving,
                                 rms, noise * std::sqrt(6.0) / step);
  return motion;
}

}  // namespace

double ClearSpeed(const Measurements& m) {
  const SampleMask moving = InMotion(m.velocity);
  const double noise = WhiteNoise(m.velocity, moving), resolution = StepOfVelocity(m.velocity);
  return std::max(
      {kClear * RootMeanSquare(Chosen(m.velocity, moving)), kDeviations * noise, 1.5 * resolution});
}

LogView ViewMotion(const Measurements& measurements, MotionSource source) {
  LogView view{measurements, {}};
  Measurements& m = view.measurements;
  const std::vector<SampleRange> pieces = PiecesOf(m);
  const double clear = ClearSpeed(m);
  // by differences where noise allows them, else by polynomials over as many samples as it takes
  std::optional<LocalMotion> motion;
  if (source == MotionSource::velocity) motion = ByDifferences(m, pieces);
  if (!motion) motion = FollowLocally(m, pieces, source);
  m.velocity = std::move(motion->velocity);
  m.acceleration = std::move(motion->acceleration);
  // mean speeds and losses between the samples
  const BetweenSamples between = MeansBetween(m, pieces, clear);
  m.mean_speed = between.mean_speed;
  m.loss_velocity = between.loss_velocity;

  // samples that move clearly, between neighbours that move alike
  auto& keep = view.selection.keep;
  keep = motion->known && m.velocity.array().abs() > clear;
  for (const auto& [first, count] : pieces) {
    for (Index i = first; i < first + count; ++i) {
      const Index before = std::max(first, i - 1), behind = std::min(first + count - 1, i + 1);
      keep[i] = keep[i] && m.velocity[before] * m.velocity[i] > 0 &&
                m.velocity[behind] * m.velocity[i] > 0;
    }
  }
  return view;
}

const LogView& MovingView(const PreparedLog& log) {
  return log.found().moving.Get([&] {
    LogView view = ViewMotion(log.taken().measurements, log.source());
    log.LeaveOut(view);
    return view;
  });
}

bool HoldsSpeeds(const Measurements& m, const Selection& selection) {
  constexpr double fewest = 0.1;  // of the samples that move clearly
  const auto moving = static_cast<double>((m.velocity.array().abs() > ClearSpeed(m)).count());
  return static_cast<double>(selection.count()) >= fewest * moving;
}

bool HoldsSpeeds(const PreparedLog& log) {
  return log.found().holds_speeds.Get(
      [&] { return HoldsSpeeds(log.taken().measurements, log.taken().selection); });
}

}  // namespace warmjoint
