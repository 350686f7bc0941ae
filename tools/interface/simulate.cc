#include <warmjoint/simulate.h>

#include "models/foundation/atomic_file.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"
#include "scenarios/read_scenario.h"
#include "sim/plant/plant.h"
#include "sim/truth/truth.h"
#include "tools/actions/outputs.h"
#include "tools/interface/convert_friction.h"
#include "tools/interface/convert_numbers.h"
#include "tools/interface/convert_recording.h"
#include "tools/interface/convert_truth.h"
#include "tools/interface/guarded.h"
#include "tools/suite/following_tally.h"

namespace warmjoint::api {
namespace {

scenarios::Settings ToSettings(const SimulateSettings& settings) {
  scenarios::Settings made;
  for (const auto& [key, value] : settings.set) made.push_back({key, value});
  return made;
}

Simulation CarryOut(scenarios::Scenario scenario, const SimulateSettings& settings) {
  if (settings.seed) scenario.seed = *settings.seed;
  const sim::Recording made = sim::MakePlant(scenario)->Run(settings.realization, settings.watch);
  return {FromMeasurements(made.measurements), FromTruth(made.truth),
          scenarios::ScenarioToYaml(scenario),
          made.following.Follows() ? "" : tools::NotFollowingInWords(made.following)};
}

}  // namespace

sim::Truth ToTruth(const Truth& truth) {
  return {ToDescription(truth.friction), truth.initial_energy,   truth.torque_noise,
          truth.coloured_noise,          truth.correlation_time, truth.plant,
          ToEigen(truth.velocity),       ToEigen(truth.force),   ToEigen(truth.loss),
          ToEigen(truth.energy)};
}

Truth FromTruth(const sim::Truth& truth) {
  return {FromDescription(truth.friction),
          truth.initial_energy,
          truth.torque_noise,
          truth.coloured_noise,
          truth.correlation_time,
          truth.plant,
          FromEigen(truth.velocity),
          FromEigen(truth.force),
          FromEigen(truth.loss),
          FromEigen(truth.energy)};
}

Simulation Simulate(const std::filesystem::path& scenario, const SimulateSettings& settings) {
  return Guarded(
      [&] { return CarryOut(scenarios::ReadScenario(scenario, ToSettings(settings)), settings); });
}

Simulation SimulateText(const std::string& scenario, const SimulateSettings& settings,
                        const std::string& name) {
  return Guarded([&] {
    return CarryOut(scenarios::ParseScenario(scenario, name, ToSettings(settings)), settings);
  });
}

void WriteSimulation(const Simulation& simulation, const std::filesystem::path& directory,
                     const std::string& format) {
  Guarded([&] {
    // a format, then a directory that appears as a whole
    if (format != "csv" && format != "h5") {
      models::Refuse({"--format"}, "is '{}'{}", models::Excerpt(format),
                     models::Suggestion(format, {"csv", "h5"}));
    }
    models::AtomicDirectory target(directory, tools::SimulatedFiles());
    tools::WriteSimulated({ToMeasurements(simulation.recording), ToTruth(simulation.truth)},
                          simulation.scenario, format, target.temporary());
    target.Commit();
  });
}

Truth ReadTruth(const std::filesystem::path& file) {
  return Guarded([&] { return FromTruth(sim::ReadTruth(file)); });
}

}  // namespace warmjoint::api
