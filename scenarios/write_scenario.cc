#include "scenarios/write_scenario.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "scenarios/scenario_words.h"
#include "scenarios/yaml_distribution.h"
#include "scenarios/yaml_disturbances.h"
#include "scenarios/yaml_friction.h"
#include "scenarios/yaml_motion.h"

namespace warmjoint::inline scenarios {

std::string QuotedYaml(const std::string& text) {
  // a JSON string is a double-quoted YAML scalar
  return nlohmann::json(text).dump();
}

std::string ScenarioToYaml(const Scenario& scenario) {
  return fmt::format("name: {}\n{}seed: {}\n", QuotedYaml(scenario.name),
                     ScenarioPartToYaml(scenario, ""), scenario.seed);
}

std::string ScenarioPartToYaml(const Scenario& scenario, const std::string& indent) {
  std::string yaml;
  const auto add = [&](std::string_view key, const std::string& value) {
    yaml += fmt::format("{}{}: {}\n", indent, key, value);
  };
  const auto begin = [&](std::string_view key) { yaml += fmt::format("{}{}:\n", indent, key); };

  // what moves
  add("plant", ChoiceName(scenario.plant, PlantKinds()));
  if (!scenario.robot.empty()) add("robot", QuotedYaml(scenario.robot));
  if (!scenario.joint.empty()) add("joint", QuotedYaml(scenario.joint));
  add("joint_kind", ChoiceName(scenario.joint_kind, JointKinds()));
  begin("friction");
  yaml += FrictionToYaml(scenario.friction, scenario.draws, indent + "  ");
  const auto energy = scenario.draws.numbers.find("initial_energy");
  add("initial_energy", energy == scenario.draws.numbers.end()
                            ? fmt::format("{}", scenario.initial_energy)
                            : DistributionToYaml(energy->second));

  // how it moves and is logged
  begin("motion");
  yaml += MotionToYaml(scenario.motion, indent + "  ");
  add("controller", fmt::format("{{bandwidth: {}, acceleration: {}}}",
                                scenario.controller.bandwidth, scenario.controller.acceleration));
  add("noise", fmt::format("{{torque: {}, velocity: {}, position: {}}}", scenario.noise.torque,
                           scenario.noise.velocity, scenario.noise.position));
  const std::string disturbances = DisturbancesToYaml(scenario.disturbances, indent + "  ");
  if (!disturbances.empty()) begin("disturbances");
  yaml += disturbances;
  add("sampling", fmt::format("{{rate: {}, sensor_rate: {}, cutoff: {}}}", scenario.sampling.rate,
                              scenario.sampling.sensor_rate, scenario.sampling.cutoff));
  add("timestep", fmt::format("{}", scenario.timestep));
  add("duration", fmt::format("{}", scenario.duration));
  return yaml;
}

}  // namespace warmjoint::inline scenarios
