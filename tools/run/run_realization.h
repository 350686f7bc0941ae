// One realization from plant to scores.
#pragma once

#include <vector>

#include "scenarios/suite.h"
#include "sim/plant.h"
#include "tools/run/prepared_identifier.h"
#include "tools/store/result.h"

namespace warmjoint {

/// Simulates realization `index` and scores every identifier on it. Never throws for what happens
/// in a plant or an identifier: it becomes the status and message of the results concerned.
/// key.seed: of the suite.
Realization RunRealization(Plant& plant, PlantKind kind,
                           const std::vector<PreparedIdentifier>& identifiers, RandomKey key);

}  // namespace warmjoint
