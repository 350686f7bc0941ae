#include "identification/adequacy/held_loss.h"

#include <cmath>

#include "identification/forward/predict.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint::inline identification {
namespace {

using Eigen::Index;

constexpr Index kParts = 8;        // of each step
constexpr double kMatters = 0.25;  // of the standard deviation of tau

/// The same log with kParts samples for each. [N kParts]
Measurements Finer(const Measurements& m) {
  Measurements finer = m;
  const Index n = m.size();
  const double last = m.time[n - 1] - m.time[n - 2];
  ForEachColumn(finer, [](Eigen::VectorXd& column) {
    column = column.transpose().replicate(kParts, 1).reshaped().eval();
  });
  for (Index i = 0; i < n * kParts; ++i) {
    const Index from = i / kParts;
    const double h = from + 1 < n ? m.time[from + 1] - m.time[from] : last;
    const double since = h * static_cast<double>(i % kParts) / static_cast<double>(kParts);
    finer.time[i] = m.time[from] + since;
    finer.position[i] = m.position[from] + since * m.velocity[from];
    if (m.motor_position) (*finer.motor_position)[i] += m.gear * since * m.velocity[from];
  }
  for (Index& start : finer.starts) start *= kParts;
  return finer;
}

}  // namespace

bool StepMatters(const Fit& fit, const Inference& inference, const Measurements& measurements) {
  if (!fit.friction.thermal || measurements.size() < 2) return false;
  const auto tau = fit.RowOf(Role::heat, 1);
  if (!tau || !inference.parameters[*tau].std) return false;
  const double gain = fit.friction.thermal->gain;
  const double power = std::abs(gain) * measurements.velocity.cwiseAbs().mean();
  return 0.5 * MedianStep(measurements.time) * power > kMatters * *inference.parameters[*tau].std;
}

Eigen::VectorXd ForceOfHeldLoss(const FrictionDescription& friction,
                                const Measurements& measurements, double initial_energy) {
  const Measurements finer = Finer(measurements);
  const Eigen::VectorXd fine = PredictFriction(friction, finer, initial_energy).force;
  const Eigen::VectorXd held = PredictFriction(friction, measurements, initial_energy).force;
  Eigen::VectorXd difference(held.size());
  for (Index n = 0; n < held.size(); ++n) difference[n] = fine[n * kParts] - held[n];
  return difference * static_cast<double>(kParts) / static_cast<double>(kParts - 1);
}

}  // namespace warmjoint::inline identification
