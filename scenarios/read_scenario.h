// Scenarios as YAML.
#pragma once

#include <string>
#include <vector>

#include "scenarios/scenario.h"

namespace warmjoint {

/// A `--set key=value` of the command line: key is a dotted path such as noise.torque.
struct Setting {
  std::string key;
  std::string value;  // YAML
};

/// Reads a scenario file and applies the settings to it. Unknown keys, wrong types and impossible
/// values throw BadInput with file:line, the value, the bound and the nearest known key.
Scenario ReadScenario(const std::string& path, const std::vector<Setting>& settings = {});

/// The whole scenario, defaults written out; ReadScenario of it gives the same scenario.
std::string ScenarioToYaml(const Scenario& scenario);

}  // namespace warmjoint
