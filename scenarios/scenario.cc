#include "scenarios/scenario.h"

#include "scenarios/truth_draws.h"

namespace warmjoint {

Scenario Realize(const Scenario& scenario, std::uint64_t realization) {
  Scenario realized = scenario;
  realized.draws = {};
  if (scenario.draws.empty()) return realized;

  // the same numbers for the same seed and realization
  RandomStream random({scenario.seed, realization}, Stream::truth);
  realized.friction = DrawFriction(scenario.friction, scenario.draws, random, {scenario.name});
  const auto energy = scenario.draws.numbers.find("initial_energy");
  if (energy != scenario.draws.numbers.end()) realized.initial_energy = energy->second.Draw(random);
  return realized;
}

}  // namespace warmjoint
