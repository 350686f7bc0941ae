#include "identification/preparation/velocity_scale.h"

#include <algorithm>
#include <cmath>

#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr double kAtRest = 1e-3;  // of the velocity's rms

/// |v[i + lag] - v[i]|, [N - lag].
Eigen::VectorXd Differences(const Eigen::VectorXd& v, Index lag) {
  return (v.tail(v.size() - lag) - v.head(v.size() - lag)).cwiseAbs();
}

/// Standard deviation of v, were it white noise, from its differences over `lag` samples.
double Spread(const Eigen::VectorXd& v, Index lag) {
  constexpr double quantile = 0.35;           // why below 0.5: half the samples may jump
  constexpr double normal_quantile = 0.4538;  // why: of |z| at 0.35, z normal
  Eigen::VectorXd differences = Differences(v, lag);
  return QuantileInPlace(differences, quantile) / (normal_quantile * std::sqrt(2.0));
}

/// Sets noise and memory.
void MeasureNoise(const Eigen::VectorXd& v, VelocityScale& scale) {
  constexpr double saturated = 1.25;  // growth below which the spread has stopped growing
  constexpr double largest = 0.05;    // of rms, for noise with a memory
  // noise from one sample to the next; over longer lags that of a memory appears and stops growing
  scale.noise = Spread(v, 1);
  double before = scale.noise;
  for (Index lag = 2; lag <= v.size() / 8; lag *= 2) {
    const double spread = Spread(v, lag);
    if (spread > saturated * before) {
      before = spread;
      continue;
    }
    // a memory is accepted only for noise that is small relative to the speed
    if (lag > 2 && before <= largest * scale.rms) {
      scale.noise = before;
      scale.memory = static_cast<double>(lag) / 2;
    }
    return;
  }
}

/// The resolution of a signal that toggles between neighbouring levels; 0 for one that only jumps
/// from one speed to the next.
double ToggleStep(const Eigen::VectorXd& v, double rms) {
  const double resolution = Resolution(v);
  if (resolution == 0 || resolution > 0.2 * rms) return 0;
  // single steps that take the one before back
  int steps = 0, toggles = 0;
  double before = 0;  // last step other than 0
  for (Index i = 1; i < v.size(); ++i) {
    const double step = v[i] - v[i - 1];
    if (std::abs(step) < 0.5 * resolution) continue;
    ++steps;
    // back by one level, after one level forth
    const bool is_single = std::abs(step) < 1.5 * resolution;
    toggles += is_single && std::abs(step + before) < 0.5 * resolution;
    before = step;
  }
  return toggles > 0.2 * steps ? resolution : 0;
}

double Steepest(const Eigen::VectorXd& v, double noise, double step) {
  double steepest = 0;
  for (Index lag = 2; lag <= v.size() / 2; lag *= 2) {
    // of two neighbours the smaller, which an outlier cannot raise
    const Eigen::VectorXd differences = Differences(v, lag);
    const Index n = differences.size();
    if (n < 2) break;
    const double largest = differences.head(n - 1).cwiseMin(differences.tail(n - 1)).maxCoeff();
    steepest = std::max(steepest, (largest - 6 * noise) / (static_cast<double>(lag) * step));
  }
  return steepest;
}

}  // namespace

double VelocityScale::Band(double level) const {
  return std::max({kFar * noise, kBand * std::abs(level), kLevels * resolution});
}

double VelocityScale::Rest() const {
  return std::max({kNear * noise, kLevels * resolution, kAtRest * rms});
}

VelocityScale MeasureVelocity(const Measurements& measurements) {
  const Eigen::VectorXd& v = measurements.velocity;
  const Index n = v.size();
  VelocityScale scale;
  scale.step = MedianStep(measurements.time);
  scale.rms = std::sqrt(v.squaredNorm() / static_cast<double>(n));
  MeasureNoise(v, scale);
  scale.resolution = ToggleStep(v, scale.rms);
  scale.steepest = Steepest(v, scale.noise, scale.step);
  return scale;
}

}  // namespace warmjoint
