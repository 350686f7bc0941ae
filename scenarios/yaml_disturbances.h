// The `disturbances` part of a scenario file.
#pragma once

#include <string>

#include "scenarios/disturbances.h"
#include "scenarios/yaml_value.h"

namespace warmjoint::inline scenarios {

/// Reads and checks disturbances. Throws BadInput with file:line.
Disturbances ReadDisturbances(const YamlValue& value);

/// The YAML of those that are not absent, one a line behind `indent`; empty where all are.
std::string DisturbancesToYaml(const Disturbances& disturbances, const std::string& indent);

}  // namespace warmjoint::inline scenarios
