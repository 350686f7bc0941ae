// Distributions as YAML: 5, {uniform: [4, 6]}, {log_uniform: [1, 100]}, {normal: [mean,
// deviation]}.
#pragma once

#include <string>

#include "scenarios/distribution.h"
#include "scenarios/yaml_value.h"

namespace warmjoint::inline scenarios {

/// Whether the value is a map that names a distribution.
bool IsDistribution(const YamlValue& value);

/// Reads a number or a distribution; its ends (a normal's mean) must satisfy the bound.
Distribution ReadDistribution(const YamlValue& value, Bound bound);

/// The YAML of it, on one line.
std::string DistributionToYaml(const Distribution& distribution);

}  // namespace warmjoint::inline scenarios
