// A plan on one machine: its tasks as processes.
#pragma once

#include <filesystem>
#include <vector>

#include "tools/cluster/plan.h"

namespace warmjoint::inline tools {

/// Runs the tasks of these shards, `at_once` at a time, as processes of their own; one that is killed is
/// started again, until its shard counts as failed. False where it was interrupted: the tasks are asked
/// to end, and what they finished is kept.
bool RunLocally(const std::filesystem::path& run, const Plan& plan, const std::vector<int>& shards,
                int at_once);

}  // namespace warmjoint::inline tools
