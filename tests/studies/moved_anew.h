// A log that a fit has not seen, of the same joint.
#pragma once

#include "sim/plant/plant.h"

namespace warmjoint {

/// The joint of a recording, its speeds and noise drawn anew.
inline Simulation MovedAnew(Scenario scenario, const Truth& truth, int realization) {
  scenario.friction = truth.friction;
  scenario.initial_energy = truth.initial_energy;
  scenario.draws = {};
  return MakePlant(scenario)->Run(static_cast<std::uint64_t>(realization));
}

}  // namespace warmjoint
