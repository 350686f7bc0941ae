// Shards of a run put together.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <vector>

#include "tools/store/copy_rows.h"
#include "tools/store/export_csv.h"
#include "tools/store/open_database.h"
#include "tools/store/result.h"

namespace warmjoint::inline tools {

/// What a merged run holds.
struct MergedRun {
  std::size_t results = 0;
  std::size_t units = 0;   // that the run has, of all variants
  std::set<Unit> missing;  // those of them that no shard holds
};

/// What is known of the shards, and what becomes of them.
struct MergeOptions {
  Overlap overlap = Overlap::refused;
  Access access = Access::read;
  /// Writes the tables for people into the merged run's directory; returns the number of results.
  std::function<std::size_t(const RunStore&)> write_tables = &ExportResults;
};

/// Makes a run directory, new or empty before, with the results of all shards and their table; as a
/// whole or not at all. Throws BadInput for shards of different runs (naming what differs), for a
/// realization that two of them hold (see Overlap), and for one that is not what its shard stored.
MergedRun MergeRuns(const std::vector<std::filesystem::path>& shards,
                    const std::filesystem::path& directory, const MergeOptions& options = {});

}  // namespace warmjoint::inline tools
