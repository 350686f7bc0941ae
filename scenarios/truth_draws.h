// What is drawn of a truth.
#pragma once

#include <map>
#include <string>

#include "scenarios/distribution.h"

namespace warmjoint::inline scenarios {

/// Truth that is drawn anew for each realization: dotted key within the scenario, for example
/// friction.parameters.viscous or initial_energy, and its distribution.
using TruthDraws = std::map<std::string, Distribution>;

}  // namespace warmjoint::inline scenarios
