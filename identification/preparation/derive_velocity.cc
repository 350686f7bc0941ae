#include "identification/preparation/derive_velocity.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "identification/preparation/position_noise.h"
#include "models/foundation/low_pass.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/measurements.h"

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

/// y at the times t, by straight lines between its samples at `time`; both increase, and t lies
/// within `time`.
Eigen::VectorXd Interpolate(const Eigen::VectorXd& time, const Eigen::VectorXd& y,
                            const Eigen::VectorXd& t) {
  Eigen::VectorXd result(t.size());
  for (Eigen::Index i = 0, k = 0; i < t.size(); ++i) {
    while (k + 2 < time.size() && time[k + 1] < t[i]) ++k;
    const double share = (t[i] - time[k]) / (time[k + 1] - time[k]);
    result[i] = y[k] + share * (y[k + 1] - y[k]);
  }
  return result;
}

/// Velocity of a piece without gaps.
Eigen::VectorXd DerivePiece(const Eigen::VectorXd& time, const Eigen::VectorXd& position,
                            double cutoff) {
  const Eigen::Index n = time.size();
  // too few samples for a filter: one slope
  if (n < 3) {
    const double moved = position[n - 1] - position[0];
    return Eigen::VectorXd::Constant(n, n == 1 ? 0 : moved / (time[1] - time[0]));
  }
  const double rate = SamplingRate(time);
  // a cutoff near half the rate filters nothing
  if (cutoff > 0.4 * rate) return Differences(time, position);

  // evenly sampled positions are filtered as they are, others on an even grid and back
  const std::vector<Biquad> filter = ButterworthLowPass(4, cutoff, rate);
  const Eigen::VectorXd steps = time.tail(n - 1) - time.head(n - 1);
  if ((steps.array() * rate - 1).abs().maxCoeff() <= 0.01) {
    return Differences(time, FilterZeroPhase(filter, position));
  }
  const Eigen::VectorXd even = Eigen::VectorXd::LinSpaced(n, time[0], time[n - 1]);
  const Eigen::VectorXd smooth = FilterZeroPhase(filter, Interpolate(time, position, even));
  return Interpolate(even, Differences(even, smooth), time);
}

}  // namespace

Eigen::VectorXd DeriveVelocity(const Eigen::VectorXd& time, const Eigen::VectorXd& position,
                               double cutoff) {
  // piece by piece: nothing is known of the motion in a gap
  Eigen::VectorXd velocity(time.size());
  for (const auto& [first, count] : PiecesOf(time)) {
    velocity.segment(first, count) =
        DerivePiece(time.segment(first, count), position.segment(first, count), cutoff);
  }
  return velocity;
}

double ChooseCutoff(const Eigen::VectorXd& time, const Eigen::VectorXd& position) {
  constexpr double highest = 100;  // Hz
  constexpr double lowest = 0.02;  // of the sampling rate
  constexpr double accepted_noise =
      0.01;  // of the velocity's rms; why: it takes 0.01^2 off a slope
  const double rate = 1 / MedianStep(time);

  // slope over a fiftieth of a second or one step, so that noise hardly enters the scale
  const Eigen::Index n = position.size();
  const auto lag = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(rate / 50), 1, n - 1);
  const Eigen::VectorXd slope =
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

}  // namespace warmjoint
