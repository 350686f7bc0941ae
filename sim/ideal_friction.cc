#include "sim/ideal_friction.h"

#include "models/friction/thermal.h"

namespace warmjoint {

FrictionHistory SimulateFriction(const FrictionDescription& friction, double initial_energy,
                                 double step, const Eigen::VectorXd& velocity, const Place& place) {
  const Law& law = *FindLaw(friction.law);
  const std::vector<double> values = LawValues(friction);
  const DiscreteThermal thermal =
      friction.thermal ? Discretise(*friction.thermal, step) : DiscreteThermal{0, 1};

  const Eigen::Index n = velocity.size();
  FrictionHistory history{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  double energy = initial_energy;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double v = velocity[i];
    const double force = WarmForce(v, law.force(v, values.data()), energy);
    if (FeedsItself(v, force)) {
      Refuse(place,
             "at {:g} s friction feeds itself: at a velocity of {:g} the energy state {:g} exceeds "
             "the nominal friction, so that F = {:g} pushes; move slower before, rest, or lower "
             "the thermal gain",
             static_cast<double>(i) * step, v, energy, force);
    }
    const double loss = Loss(v, force);
    history.force[i] = force;
    history.loss[i] = loss;
    history.energy[i] = energy;
    energy = ThermalStep(thermal.gain, thermal.pole, energy, loss);
  }
  return history;
}

}  // namespace warmjoint
