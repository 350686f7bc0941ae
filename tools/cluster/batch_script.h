// What Slurm is given: scripts that people may read, edit and submit by hand.
#pragma once

#include <filesystem>
#include <string>

#include "tools/cluster/plan.h"

namespace warmjoint::inline tools {

/// Refuses --sbatch entries that are no key=value, or that a plan sets itself.
void CheckSbatch(const std::vector<std::string>& entries);

/// The script of the array: task i of it runs shard offset + i + 1, offset being the script's argument.
/// run: absolute. most_indices: the cluster's MaxArraySize.
std::string ArrayScript(const Plan& plan, const std::filesystem::path& run, int most_indices);

/// The script of the job that merges.
std::string MergeScript(const Plan& plan, const std::filesystem::path& run);

/// How to do the same without Slurm, by GNU parallel.
std::string ParallelRecipe(const Plan& plan, const std::filesystem::path& run);

}  // namespace warmjoint::inline tools
