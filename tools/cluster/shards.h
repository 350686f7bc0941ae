// The shards of a run: computed here, and put together.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "tools/cluster/plan.h"
#include "tools/store/run_store.h"

namespace warmjoint {

/// Copies a finished shard's results beside their place in the run and gives them their name there by one
/// rename, on disk before.
void Publish(const Plan& plan, int number, const std::filesystem::path& results);

/// How the shards of this machine ended.
struct LocalEnd {
  bool interrupted = false;
  int failed = 0;  // number of a shard that ended without results; 0: none
  int status = 0;  // of its process
};

/// Runs the shards without results as processes of their own, `at_once` at a time. One that is killed
/// begins anew, three times at most. An interrupt ends all of them.
LocalEnd RunLocally(const Plan& plan, int at_once, const std::vector<std::string>& more);

/// What a merged run holds.
struct MergedRun {
  std::size_t units = 0;      // that the run has, of all variants
  std::set<RunUnit> missing;  // those of them that no shard holds
};

/// Makes a run directory, new or empty before, with the results of all shards and the
/// tables for people; as a whole or not at all. Throws BadInput for shards of different runs (naming
/// what differs), for one that is damaged, and for a realization that two of them hold.
MergedRun MergeRuns(const std::vector<std::filesystem::path>& shards,
                    const std::filesystem::path& directory);

/// Puts the shards of RUN together as RUN itself: suite.yaml, results.csv, summary.csv and results.sqlite,
/// made on this machine's own disk. Throws BadInput where shards are missing, naming them.
void MergePlanned(const Plan& plan);

}  // namespace warmjoint
