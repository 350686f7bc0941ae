// The shards of a planned run: computed here, and put together.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/cluster/plan.h"
#include "tools/store/merge_runs.h"

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

/// Puts the shards of RUN together as RUN itself: suite.yaml, results.csv, summary.csv and results.sqlite,
/// made on this machine's own disk. Throws BadInput where shards are missing, naming them.
void MergePlanned(const Plan& plan);

}  // namespace warmjoint
