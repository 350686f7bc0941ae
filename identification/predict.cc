#include "identification/predict.h"

namespace warmjoint {

Prediction PredictFriction(const FrictionDescription& friction, const Measurements& measurements,
                           double initial_energy) {
  const Law& law = *FindLaw(friction.law);
  const std::vector<double> values = LawValues(friction);
  const Eigen::Index n = measurements.size();
  Prediction prediction{Eigen::VectorXd(n), Eigen::VectorXd(n), n};

  double energy = initial_energy;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double v = measurements.velocity[i];
    const double force = WarmForce(v, law.force(v, values.data()), energy);
    prediction.force[i] = force;
    prediction.energy[i] = energy;
    if (FeedsItself(v, force) && prediction.feeds_itself == n) prediction.feeds_itself = i;

    // hold the loss until the next sample
    if (!friction.thermal || i + 1 == n) continue;
    const double h = measurements.time[i + 1] - measurements.time[i];
    const DiscreteThermal step = Discretise(*friction.thermal, h);
    energy = ThermalStep(step.gain, step.pole, energy, Loss(v, force));
  }
  return prediction;
}

}  // namespace warmjoint
