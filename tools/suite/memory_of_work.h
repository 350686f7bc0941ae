// What simulating and judging take, known before it is taken.
#pragma once

#include "scenarios/suite.h"
#include "tools/suite/shard.h"

namespace warmjoint::inline tools {

/// Throws BadInput where one recording of the scenario does not fit into memory, with the amount and the keys.
/// file: that the scenario came from.
void RequireMemoryFor(const Scenario& scenario, const std::string& file);

/// The same for a run: one recording for each thread at a time, and the results of the shard. It also refuses more
/// units than can be counted.
void RequireMemoryFor(const Suite& suite, const Shard& shard, int jobs, const std::string& file);

}  // namespace warmjoint::inline tools
