// Shards of a run put together.
#pragma once

#include <filesystem>
#include <vector>

#include "tools/store/run_store.h"

namespace warmjoint::inline tools {

/// Makes a run directory with the results of all shards. Throws BadInput for shards of different
/// runs (naming what differs) and for a realization that two of them hold.
RunStore MergeRuns(const std::vector<std::filesystem::path>& shards,
                   const std::filesystem::path& directory);

}  // namespace warmjoint::inline tools
