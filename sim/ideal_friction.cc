#include "sim/ideal_friction.h"

#include "models/friction/thermal.h"

namespace warmjoint {
namespace {

DiscreteThermal DiscretiseOrNone(const std::optional<Thermal>& thermal, double step) {
  return thermal ? Discretise(*thermal, step) : DiscreteThermal{0, 1};
}

}  // namespace

FrictionHistory SimulateFriction(const FrictionDescription& friction, double initial_energy,
                                 double step, const Eigen::VectorXd& velocity, const Place& place,
                                 const LevelInfluences& influences) {
  const Law& law = *FindLaw(friction.law);
  const std::vector<double> values = LawValues(friction);
  const DiscreteThermal first = DiscretiseOrNone(friction.thermal, step);
  const DiscreteThermal second = DiscretiseOrNone(influences.second_heat, step);

  const Eigen::Index n = velocity.size();
  FrictionHistory history{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  double energy = initial_energy;
  double second_energy = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double v = velocity[i];
    const double extra = influences.level.size() > 0 ? influences.level[i] : 0.0;
    const double level = energy + second_energy + extra;
    const double force = WarmForce(v, law.force(v, values.data()), level);
    if (FeedsItself(v, force)) {
      Refuse(place,
             "at {:g} s friction feeds itself: at a velocity of {:g} the energy state {:g} exceeds "
             "the nominal friction, so that F = {:g} pushes; move slower before, rest, or lower "
             "the thermal gain",
             static_cast<double>(i) * step, v, level, force);
    }
    const double loss = Loss(v, force);
    history.force[i] = force;
    history.loss[i] = loss;
    history.energy[i] = energy + second_energy;
    energy = ThermalStep(first.gain, first.pole, energy, loss);
    second_energy = ThermalStep(second.gain, second.pole, second_energy, loss);
  }
  return history;
}

}  // namespace warmjoint
