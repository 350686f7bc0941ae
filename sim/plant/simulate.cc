#include <fmt/format.h>
#include <warmjoint/simulation.h>

#include "scenarios/read_scenario.h"
#include "sim/plant/plant.h"

namespace warmjoint::inline sim {

std::string Following::Words() const {
  std::string cure = fmt::format("controller.bandwidth to {:g} rad/s", sufficient);
  if (timestep != 0) cure += fmt::format(" and timestep to {:g} s", timestep);
  return fmt::format(
      "the joint reached its commanded speed in {:.0f} % of the time. Its drive of {:g} "
      "rad/s is too slow for it: set {}",
      100 * share, bandwidth, cure);
}

Simulation Simulate(const std::filesystem::path& scenario, const SimulateSettings& settings) {
  Settings set;
  for (const auto& [key, value] : settings.set) set.push_back({key, value});
  Scenario read = ReadScenario(scenario, set);
  if (settings.seed) read.seed = *settings.seed;
  return MakePlant(read)->Run(settings.realization, settings.watch);
}

}  // namespace warmjoint::inline sim
