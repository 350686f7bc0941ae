// Shards of a run put together.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <vector>

#include "tools/store/run_store.h"

namespace warmjoint {

/// What a merged run holds.
struct MergedRun {
  std::size_t units = 0;      // that the run has, of all variants
  std::set<RunUnit> missing;  // those of them that no shard holds
};

/// Makes a run directory, new or empty before, with the results of all shards, and lets write_tables add
/// the tables for people; as a whole or not at all. Throws BadInput for shards of different runs (naming
/// what differs), for one that is damaged, and for a realization that two of them hold.
MergedRun MergeRuns(const std::vector<std::filesystem::path>& shards,
                    const std::filesystem::path& directory,
                    const std::function<void(const RunStore&)>& write_tables);

}  // namespace warmjoint
