// The `friction` part of a scenario file.
#pragma once

#include <string>

#include "models/friction/friction_description.h"
#include "scenarios/truth_draws.h"
#include "scenarios/yaml_value.h"

namespace warmjoint::inline scenarios {

/// Reads the layout of a friction file (friction_description.h) written as YAML, or the path of
/// such a file or of estimate.json relative to the scenario's. Numbers may be distributions, uniform or
/// log-uniform, that join `draws`; the description then holds their middles. {estimate: FILE, draw:
/// posterior} draws what the estimate leaves open, and is written as the key `posterior` beside the
/// estimate's friction. Throws BadInput with file:line.
FrictionDescription ReadFriction(const YamlValue& value, TruthDraws& draws);

/// The YAML of it, each line behind `indent`; draws take the place of the numbers that they set.
std::string FrictionToYaml(const FrictionDescription& friction, const TruthDraws& draws,
                           const std::string& indent);

/// The description with the numbers of one realization, drawn in the order of their keys.
FrictionDescription DrawFriction(const FrictionDescription& friction, const TruthDraws& draws,
                                 RandomStream& random, const Place& place);

}  // namespace warmjoint::inline scenarios
