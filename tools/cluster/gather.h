// The shards of a planned run as one run.
#pragma once

#include <filesystem>

#include "tools/cluster/plan.h"
#include "tools/store/merge_runs.h"

namespace warmjoint::inline tools {

/// Puts the shards of RUN together as RUN itself: results.sqlite, results.csv and
/// suite.yaml, with the bytes of a run on one machine. They are made on this machine's own disk and take
/// their names when they are whole. Throws BadInput where shards are missing, naming them.
MergedRun MergePlanned(const std::filesystem::path& run, const Plan& plan);

}  // namespace warmjoint::inline tools
