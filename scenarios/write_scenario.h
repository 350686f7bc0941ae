// Scenarios written as YAML; the layout is that of read_scenario.h.
#pragma once

#include <string>

#include "scenarios/scenario.h"

namespace warmjoint::inline scenarios {

/// The whole scenario, defaults written out; reading it gives the same scenario bit for bit.
std::string ScenarioToYaml(const Scenario& scenario);

/// The same without name and seed, which a suite holds itself. indent: before each line.
std::string ScenarioPartToYaml(const Scenario& scenario, const std::string& indent);

/// Text as a YAML scalar, quoted, so that it reads back whatever it holds.
std::string QuotedYaml(const std::string& text);

}  // namespace warmjoint::inline scenarios
