#include "sim/plant/disturb_log.h"

#include <cmath>
#include <numbers>

#include "models/foundation/low_pass.h"
#include "sim/plant/hidden_forces.h"
#include "sim/plant/sensor_faults.h"

namespace warmjoint::inline sim {
namespace {

void AddColouredNoise(const ColouredNoise& noise, double rate, RandomStream random,
                      Simulation& recording) {
  if (noise.deviation == 0) return;
  // an AR(1) process that begins settled: its deviation is the same at each sample
  const double memory = std::exp(-1 / (rate * noise.correlation_time));
  const double fresh =
      noise.deviation * std::sqrt(-std::expm1(-2 / (rate * noise.correlation_time)));
  double value = noise.deviation * random.Normal();
  for (double& torque : recording.measurements.torque) {
    torque += value;
    value = memory * value + fresh * random.Normal();
  }

  // the truth knows both parts of the noise
  recording.truth.torque_noise = std::hypot(recording.truth.torque_noise, noise.deviation);
  recording.truth.coloured_noise = noise.deviation;
  recording.truth.correlation_time = noise.correlation_time;
}

void AddUnevenNoise(const UnevenNoise& noise, RandomStream random, Simulation& recording) {
  if (noise == UnevenNoise{}) return;
  const Truth& truth = recording.truth;
  // a deviation of each sample, with friction and speed
  const Eigen::VectorXd deviation =
      noise.of_torque * truth.force.cwiseAbs() + noise.of_speed * truth.velocity.cwiseAbs();
  for (Eigen::Index i = 0; i < deviation.size(); ++i) {
    recording.measurements.torque[i] += deviation[i] * random.Normal();
  }
}

void AddPeriodicTorque(const PeriodicTorque& periodic, RandomStream random, Measurements& log) {
  if (periodic.amplitude == 0) return;
  // where its period begins is drawn
  const double phase = 2 * std::numbers::pi * random.Uniform();
  log.torque.array() += periodic.amplitude *
                        (2 * std::numbers::pi / periodic.period * log.time.array() + phase).sin();
}

void AddOutliers(const Outliers& outliers, RandomStream random, Measurements& log) {
  if (outliers.fraction == 0) return;
  for (double& torque : log.torque) {
    if (random.Uniform() >= outliers.fraction) continue;
    const double off = outliers.size * random.Normal();
    torque += outliers.one_sided > 0 ? std::abs(off) : off;
  }
}

}  // namespace

void DisturbLog(const Scenario& scenario, std::uint64_t realization, Simulation& recording,
                const Eigen::VectorXd& position, const Eigen::VectorXd& acceleration) {
  const RandomKey key{scenario.seed, realization};
  const Disturbances& disturbances = scenario.disturbances;
  // what the torque has beside friction: its lag and hidden forces
  Measurements& log = recording.measurements;
  if (const double lag = disturbances.torque_lag.time_constant; lag > 0) {
    log.torque += LowPass(log.time, recording.truth.force, lag) - recording.truth.force;
  }
  log.torque +=
      HiddenTorque(disturbances, log.time, recording.truth.velocity, position, acceleration);

  // what sensors make of the motion, then noise on the torque
  DisturbMotion(disturbances, log);
  AddColouredNoise(disturbances.coloured_noise, scenario.sampling.rate,
                   {key, Stream::coloured_noise}, recording);
  AddUnevenNoise(disturbances.uneven_noise, {key, Stream::uneven_noise}, recording);
  AddPeriodicTorque(disturbances.periodic_torque, {key, Stream::periodic_torque},
                    recording.measurements);
  AddOutliers(disturbances.outliers, {key, Stream::outliers}, recording.measurements);

  // faults last, since they spoil all that was measured
  SpoilLog(disturbances.faults, recording);
  LoseSamples(disturbances.faults.lost_samples, {key, Stream::lost_samples}, recording);
}

}  // namespace warmjoint::inline sim
