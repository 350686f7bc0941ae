#include "sim/plant/disturb_log.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace warmjoint::inline sim {
namespace {

void AddColouredNoise(const ColouredNoise& noise, double rate, RandomStream random,
                      Recording& recording) {
  if (noise.deviation == 0) return;
  const double memory = std::exp(-1 / (rate * noise.correlation_time));
  const double fresh =
      noise.deviation * std::sqrt(-std::expm1(-2 / (rate * noise.correlation_time)));
  double value = noise.deviation * random.Normal();
  for (double& torque : recording.measurements.torque) {
    torque += value;
    value = memory * value + fresh * random.Normal();
  }
  recording.truth.torque_noise = std::hypot(recording.truth.torque_noise, noise.deviation);
  recording.truth.coloured_noise = noise.deviation;
  recording.truth.correlation_time = noise.correlation_time;
}

void AddPeriodicTorque(const PeriodicTorque& periodic, RandomStream random, Measurements& log) {
  if (periodic.amplitude == 0) return;
  const double phase = 2 * std::numbers::pi * random.Uniform();
  log.torque.array() += periodic.amplitude *
                        (2 * std::numbers::pi / periodic.period * log.time.array() + phase).sin();
}

void AddOutliers(const Outliers& outliers, RandomStream random, Measurements& log) {
  if (outliers.fraction == 0) return;
  for (double& torque : log.torque) {
    if (random.Uniform() < outliers.fraction) torque += outliers.size * random.Normal();
  }
}

/// What is left of x after a first-order low-pass that each sample's value drives until the next
/// one; settled on the first. time: [N] s.
Eigen::VectorXd LowPass(const Eigen::VectorXd& time, const Eigen::VectorXd& x,
                        double time_constant) {
  Eigen::VectorXd filtered = x;
  for (Eigen::Index i = 1; i < x.size(); ++i) {
    const double share = -std::expm1(-(time[i] - time[i - 1]) / time_constant);
    filtered[i] = filtered[i - 1] + share * (x[i - 1] - filtered[i - 1]);
  }
  return filtered;
}

/// Changes of the friction that no model knows, along the direction of motion, [N] N.m or N.
Eigen::VectorXd UnknownFriction(const Disturbances& disturbances, const Truth& truth,
                                const Eigen::VectorXd& time) {
  const auto& [parity, step, run_in] =
      std::tie(disturbances.hold_parity, disturbances.step_in_time, disturbances.run_in);
  Eigen::VectorXd friction(time.size());
  bool odd = false;
  double held = 0;  // sign of the last motion
  for (Eigen::Index i = 0; i < time.size(); ++i) {
    const double v = truth.velocity[i];
    const double sign = v > 0 ? 1 : v < 0 ? -1 : 0;
    if (sign != 0 && sign != held) {
      odd = held != 0 && !odd;
      held = sign;
    }
    double level = odd ? parity.level : 0;
    if (time[i] >= step.time) level += step.level;
    level += run_in.level * std::exp(-time[i] / run_in.time_constant);
    friction[i] = sign * level;
  }
  return friction;
}

/// The motion as poorer sensors tell it.
void DisturbMotion(const Disturbances& disturbances, Measurements& log) {
  if (disturbances.velocity_filter.time_constant > 0) {
    log.velocity = LowPass(log.time, log.velocity, disturbances.velocity_filter.time_constant);
  }
  const auto late = static_cast<Eigen::Index>(disturbances.stale_position.samples);
  if (late > 0) {
    const Eigen::Index n = std::max<Eigen::Index>(log.size() - late, 1);
    const Eigen::VectorXd position = log.position;
    log.position.tail(n) = position.head(n);
    log.position.head(log.size() - n).setConstant(position[0]);
  }
  if (const double step = disturbances.encoder.resolution; step > 0) {
    log.position = step * (log.position / step).array().round();
  }
  if (disturbances.without_velocity) log.velocity.resize(0);
}

}  // namespace

void DisturbLog(const Scenario& scenario, std::uint64_t realization, Recording& recording) {
  const RandomKey key{scenario.seed, realization};
  const Disturbances& disturbances = scenario.disturbances;
  Measurements& log = recording.measurements;
  if (const double lag = disturbances.torque_lag.time_constant; lag > 0) {
    log.torque += LowPass(log.time, recording.truth.force, lag) - recording.truth.force;
  }
  log.torque += UnknownFriction(disturbances, recording.truth, log.time);
  DisturbMotion(disturbances, log);
  AddColouredNoise(disturbances.coloured_noise, scenario.sampling.rate,
                   {key, Stream::coloured_noise}, recording);
  AddPeriodicTorque(disturbances.periodic_torque, {key, Stream::periodic_torque},
                    recording.measurements);
  AddOutliers(disturbances.outliers, {key, Stream::outliers}, recording.measurements);
}

}  // namespace warmjoint::inline sim
