#include "identification/preparation/moving_view.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "identification/preparation/between_samples.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/recordings_of.h"
#include "models/recording/sampling.h"

namespace warmjoint::inline identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kWidest = 32;        // samples on each side of a slope
constexpr double kAccepted = 0.05;   // noise of the acceleration, of its root mean square
constexpr double kClear = 0.05;      // of the velocity's root mean square
constexpr double kJump = 0.1;        // of the acceleration's root mean square
constexpr double kBeyondMedian = 4;  // of the change from one side of a sample to the other
constexpr double kDeviations = 5;    // of the noise

double RootMeanSquare(const VectorXd& x) {
  return x.size() == 0 ? 0 : std::sqrt(x.squaredNorm() / static_cast<double>(x.size()));
}

/// Step of a quantised velocity, rad/s or m/s. Ramps of one slope between constant speeds change by
/// one step, too, but sample after sample.
double StepOf(const VectorXd& velocity) {
  const double step = Resolution(velocity);
  if (step == 0) return 0;
  Index changes = 0, again = 0;
  for (Index i = 1; i + 1 < velocity.size(); ++i) {
    const double change = velocity[i] - velocity[i - 1];
    if (std::abs(change) < 0.5 * step) continue;
    ++changes;
    again += std::abs(velocity[i + 1] - velocity[i] - change) < 0.5 * step;
  }
  return 2 * again > changes ? 0 : step;
}

/// Standard deviation of the velocity's samples, rad/s or m/s.
double NoiseOf(const VectorXd& velocity) {
  return std::max(WhiteNoise(velocity), StepOf(velocity) / std::sqrt(12.0));
}

/// Pieces without gaps, each of one recording.
std::vector<SampleRange> PiecesOf(const Measurements& m) {
  std::vector<SampleRange> pieces;
  for (const auto& [first, count] : RecordingsOf(m)) {
    const double longest = count < 2 ? 0 : LongestStep(m.time.segment(first, count));  // s
    Index begin = first;
    for (Index i = first + 1; i <= first + count; ++i) {
      if (i < first + count && m.time[i] - m.time[i - 1] <= longest) continue;
      pieces.push_back({begin, i - begin});
      begin = i;
    }
  }
  return pieces;
}

/// Slopes of lines through the samples up to w away, as far as the piece reaches.
void SlopesOf(const Measurements& m, const SampleRange& piece, Index w, VectorXd& slopes) {
  const auto& [first, count] = piece;
  for (Index i = 0; i < count; ++i) {
    const Index begin = std::max<Index>(0, i - w), end = std::min(count, i + w + 1);
    const auto t = m.time.segment(first + begin, end - begin).array();
    const auto v = m.velocity.segment(first + begin, end - begin).array();
    const double middle = t.mean();
    const double spread = (t - middle).square().sum();
    slopes[first + i] = spread > 0 ? ((t - middle) * v).sum() / spread : 0;
  }
}

/// How much the acceleration differs from one side of each sample to the other; 0 at the ends of
/// pieces. [N]
VectorXd Jumps(const Measurements& m, const std::vector<SampleRange>& pieces) {
  VectorXd jumps = VectorXd::Zero(m.size());
  for (const auto& [first, count] : pieces) {
    for (Index i = first + 1; i + 1 < first + count; ++i) {
      const double before = (m.velocity[i] - m.velocity[i - 1]) / (m.time[i] - m.time[i - 1]);
      const double behind = (m.velocity[i + 1] - m.velocity[i]) / (m.time[i + 1] - m.time[i]);
      jumps[i] = std::abs(behind - before);
    }
  }
  return jumps;
}

}  // namespace

double ClearSpeed(const Measurements& m) {
  const double noise = WhiteNoise(m.velocity), resolution = StepOf(m.velocity);
  return std::max({kClear * RootMeanSquare(m.velocity), kDeviations * noise, 1.5 * resolution});
}

VectorXd Acceleration(const Measurements& m) {
  const std::vector<SampleRange> pieces = PiecesOf(m);
  const double noise = NoiseOf(m.velocity);
  const double step = MedianStep(m.time);
  VectorXd slopes = VectorXd::Zero(m.size());
  for (Index w = 1; w <= kWidest; w *= 2) {
    for (const SampleRange& piece : pieces) SlopesOf(m, piece, w, slopes);

    // of the noise, sum of k^2 over -w, ..., w
    const double squares = static_cast<double>(w * (w + 1) * (2 * w + 1)) / 3;
    const double left = noise / (step * std::sqrt(squares));
    const double rms = RootMeanSquare(slopes);
    if (left * left <= kAccepted * kAccepted * (rms * rms - left * left)) break;
  }
  return slopes;
}

LogView ViewMotion(const Measurements& measurements) {
  LogView view{measurements, {}};
  Measurements& m = view.measurements;
  const std::vector<SampleRange> pieces = PiecesOf(m);
  m.acceleration = Acceleration(m);

  // samples that move clearly, between neighbours that move alike
  const double clear = ClearSpeed(m);
  const BetweenSamples between = MeansBetween(m, pieces, clear);
  m.mean_speed = between.mean_speed;
  m.loss_velocity = between.loss_velocity;
  auto& keep = view.selection.keep;
  keep = m.velocity.array().abs() > clear;
  for (const auto& [first, count] : pieces) {
    for (Index i = first; i < first + count; ++i) {
      const Index before = std::max(first, i - 1), behind = std::min(first + count - 1, i + 1);
      keep[i] = keep[i] && m.velocity[before] * m.velocity[i] > 0 &&
                m.velocity[behind] * m.velocity[i] > 0;
    }
  }

  // and whose acceleration does not jump
  const VectorXd jumps = Jumps(m, pieces);
  VectorXd ordered = jumps;
  const double noise = NoiseOf(m.velocity) * std::sqrt(6.0) / MedianStep(m.time);
  const double most = std::max({kJump * RootMeanSquare(*m.acceleration),
                                kBeyondMedian * MedianInPlace(ordered), kDeviations * noise});
  keep = keep && jumps.array() <= most;
  return view;
}

}  // namespace warmjoint::inline identification
