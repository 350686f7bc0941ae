#include "sim/plant/disturb_log.h"

#include <cmath>
#include <numbers>

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

}  // namespace

void DisturbLog(const Scenario& scenario, std::uint64_t realization, Recording& recording) {
  const RandomKey key{scenario.seed, realization};
  const Disturbances& disturbances = scenario.disturbances;
  AddColouredNoise(disturbances.coloured_noise, scenario.sampling.rate,
                   {key, Stream::coloured_noise}, recording);
  AddPeriodicTorque(disturbances.periodic_torque, {key, Stream::periodic_torque},
                    recording.measurements);
  AddOutliers(disturbances.outliers, {key, Stream::outliers}, recording.measurements);
}

}  // namespace warmjoint::inline sim
