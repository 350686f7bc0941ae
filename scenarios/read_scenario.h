// Scenarios as YAML: scenarios/keys.md has all keys, with units and defaults, as the structs' Serialize tell them.
#pragma once

#include <string>

#include "models/foundation/node.h"
#include "scenarios/scenario.h"

namespace warmjoint {

/// Reads a scenario file and applies the settings to it. Unknown keys, wrong types and impossible
/// values throw BadInput with file:line, the value, the bound and the nearest known key.
Scenario ReadScenario(const std::string& path, const Settings& settings = {});

/// The same of a text; file: what refusals name, and where relative paths start.
Scenario ParseScenario(const std::string& text, const std::string& file,
                       const Settings& settings = {});

/// The same for a value that is part of a larger file. name: of the scenario where it gives none.
Scenario ScenarioFrom(const Node& node, const std::string& name);

/// The scenario with settings applied to it, checked like a file.
Scenario WithSettings(const Scenario& scenario, const Settings& settings);

/// The whole scenario, defaults written out; reading it gives the same scenario bit for bit.
std::string ScenarioToYaml(const Scenario& scenario);

/// A motion and a duration, s, as settings of a scenario.
Settings MotionSettings(const Motion& motion, double duration);

}  // namespace warmjoint
