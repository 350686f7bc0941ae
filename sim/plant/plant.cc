#include "sim/plant/plant.h"

#include <fmt/format.h>
#include <warmjoint/recording.h>

#include "models/foundation/bad_input.h"
#include "scenarios/read_scenario.h"
#include "scenarios/scenario.h"

namespace warmjoint {
namespace {

std::unique_ptr<Plant> MakeFixedPlant(const Scenario& scenario) {
  const double samples = scenario.duration * scenario.sampling.rate;
  if (samples > static_cast<double>(kMostSamples)) {
    Refuse({scenario.name},
           "duration {:g} s at sampling.rate {:g} Hz makes {:g} samples; {} at most: shorten "
           "duration or lower sampling.rate",
           scenario.duration, scenario.sampling.rate, samples, kMostSamples);
  }
  switch (scenario.plant) {
    case PlantKind::ideal:
      return MakeIdealPlant(scenario);
    case PlantKind::mujoco:
      return MakeMujocoPlant(scenario);
  }
  Refuse({scenario.name}, "there is no such plant");
}

/// A plant made anew for each realization, whose truth is drawn.
class DrawnPlant : public Plant {
 public:
  explicit DrawnPlant(const Scenario& scenario) : scenario_(scenario) {
    // what cannot run in the middle of the draws is refused before anything runs
    Scenario middle = scenario;
    middle.draws = {};
    MakeFixedPlant(middle);
  }

  Simulation Run(std::uint64_t realization, const RunWatch& watch) override {
    return MakeFixedPlant(Realize(scenario_, realization))->Run(realization, watch);
  }

 private:
  const Scenario scenario_;
};

}  // namespace

std::unique_ptr<Plant> MakePlant(const Scenario& scenario) {
  if (scenario.draws.empty()) return MakeFixedPlant(scenario);
  return std::make_unique<DrawnPlant>(scenario);
}

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

}  // namespace warmjoint
