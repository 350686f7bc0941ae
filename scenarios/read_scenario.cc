#include "scenarios/read_scenario.h"

#include <filesystem>

#include "models/foundation/atomic_file.h"
#include "models/foundation/serialize.h"
#include "scenarios/yaml.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;

/// A path stands relative to the file that names it; a robot of the project has a name alone.
std::string RobotIn(const Node& node) {
  const std::string robot = node.Text();
  const fs::path near = fs::path(node.file()).parent_path() / robot;
  return fs::path(robot).has_extension() && fs::exists(near) ? near.string() : robot;
}

/// What a simulation may take of memory and time.
void CheckCounts(const Node& duration, const Scenario& scenario) {
  constexpr double fewest = 3, most = 1e8, most_steps = 1e10;
  const double samples = scenario.duration * scenario.sampling.rate;
  if (samples < fewest || samples > most) {
    Refuse(duration.place(),
           "{} s at a sampling.rate of {} Hz make {:g} samples; a recording has {:g} to {:g}",
           scenario.duration, scenario.sampling.rate, samples, fewest, most);
  }
  const double steps = scenario.duration / scenario.timestep;
  if (scenario.plant != PlantKind::mujoco || steps <= most_steps) return;
  Refuse(duration.place(),
         "{} s at a timestep of {} s make {:g} steps of the engine; {:g} at most: lengthen "
         "timestep or shorten duration",
         scenario.duration, scenario.timestep, steps, most_steps);
}

/// What acts must be known to the plant, and act on something.
void CheckDisturbances(const Node& node, const Scenario& scenario) {
  // what is at its default is not written
  const Tree given =
      scenario.plant == PlantKind::ideal ? Tree::object() : WriteFields(scenario.disturbances);
  for (const char* ideal_only : {"gravity", "ambient_drift", "load_change", "second_heat"}) {
    if (!given.contains(ideal_only)) continue;
    Refuse(node.place(), "{}.{} is known to the ideal plant alone; take it out, or use it",
           node.key(), ideal_only);
  }
  if (scenario.disturbances.ambient_temperature.amplitude == 0) return;
  if (scenario.friction.level_per_temperature != 0) return;
  Refuse(node.place(),
         "{}.ambient_temperature changes nothing while friction.level_per_temperature is 0",
         node.key());
}

}  // namespace

Scenario ScenarioFrom(const Node& node, const std::string& name) {
  Scenario scenario;
  scenario.name = name;
  ReadFields(node, &scenario);
  if (const auto robot = node.Find("robot")) scenario.robot = RobotIn(*robot);
  // what no single value says
  if (const auto part = node.Find("disturbances")) CheckDisturbances(*part, scenario);
  CheckCounts(node.Require("duration", ""), scenario);
  return scenario;
}

Scenario ParseScenario(const std::string& text, const std::string& file, const Settings& settings) {
  return ScenarioFrom(ParseYaml(text, file, settings), fs::path(file).stem().string());
}

Scenario ReadScenario(const std::string& path, const Settings& settings) {
  return ParseScenario(ReadWholeFile(path, kLargestDocument), path, settings);
}

Scenario WithSettings(const Scenario& scenario, const Settings& settings) {
  return ScenarioFrom(ParseYaml(ScenarioToYaml(scenario), scenario.name, settings), scenario.name);
}

std::string ScenarioToYaml(const Scenario& scenario) { return ToYaml(WriteFields(scenario)); }

Settings MotionSettings(const Motion& motion, double duration) {
  return {{"motion", ToFlowYaml(WriteFields(motion))}, {"duration", fmt::format("{}", duration)}};
}

}  // namespace warmjoint
