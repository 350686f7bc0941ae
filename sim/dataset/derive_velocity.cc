#include "sim/dataset/derive_velocity.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sim/dataset/butterworth.h"
#include "sim/dataset/robust_noise.h"

namespace warmjoint {
namespace {

double SamplingRate(const Eigen::VectorXd& time) {
  const Eigen::Index n = time.size();
  return static_cast<double>(n - 1) / (time[n - 1] - time[0]);
}

/// Central differences, one-sided at the ends.
Eigen::VectorXd Differences(const Eigen::VectorXd& time, const Eigen::VectorXd& x) {
  const Eigen::Index n = x.size();
  Eigen::VectorXd slope(n);
  slope.segment(1, n - 2) =
      (x.tail(n - 2) - x.head(n - 2)).cwiseQuotient(time.tail(n - 2) - time.head(n - 2));
  slope[0] = (x[1] - x[0]) / (time[1] - time[0]);
  slope[n - 1] = (x[n - 1] - x[n - 2]) / (time[n - 1] - time[n - 2]);
  return slope;
}

}  // namespace

Eigen::VectorXd DeriveVelocity(const Eigen::VectorXd& time, const Eigen::VectorXd& position,
                               double cutoff) {
  const double rate = SamplingRate(time);
  if (cutoff > 0.4 * rate) return Differences(time, position);
  return Differences(time, FilterZeroPhase(ButterworthLowPass(4, cutoff, rate), position));
}

double ChooseCutoff(const Eigen::VectorXd& time, const Eigen::VectorXd& position) {
  constexpr double highest = 100;          // Hz
  constexpr double lowest = 0.02;          // of the sampling rate
  constexpr double accepted_noise = 0.01;  // of the velocity's root mean square
  const double rate = SamplingRate(time);

  // slope over a fiftieth of a second or one step, so that noise hardly enters the scale
  const Eigen::Index n = position.size();
  const auto lag = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(rate / 50), 1, n - 1);
  const Eigen::VectorXd slope =
      (position.tail(n - lag) - position.head(n - lag)) * (rate / static_cast<double>(lag));
  const double speed = std::sqrt(slope.squaredNorm() / static_cast<double>(slope.size()));

  const double noise = std::max(WhiteNoise(position), Resolution(position) / std::sqrt(12.0));
  if (noise == 0) return highest;
  const double ratio = accepted_noise * speed / (2 * std::numbers::pi * noise);
  const double cutoff = std::cbrt(1.5 * ratio * ratio * rate);
  return std::clamp(cutoff, std::min(lowest * rate, highest), highest);
}

}  // namespace warmjoint
