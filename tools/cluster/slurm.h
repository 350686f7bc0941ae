// A planned run on a Slurm cluster.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/cluster/plan.h"

namespace warmjoint {

/// Refuses --sbatch entries that are no key=value, or that the script sets itself.
void CheckSbatch(const std::vector<std::string>& entries);

/// Refuses a plan with more shards than an array of this cluster takes (MaxArraySize).
void RefuseLargeArray(int shards);

/// RUN/slurm/array.sbatch, which people may read, edit and submit by hand: as an array its task i runs
/// shard i, and without one it merges. sbatch: key=value, handed on. more: what `run` is told of a shard.
std::string ArrayScript(const Plan& plan, const std::vector<std::string>& sbatch, int jobs,
                        const std::vector<std::string>& more);

/// What Slurm's queue holds of a run.
struct QueuedShards {
  std::vector<int> running, waiting;  // ascending
  std::vector<std::string> jobs;      // of all these
};

/// Nothing where nobody can be asked.
std::optional<QueuedShards> AskQueue(const Plan& plan);

/// Submits the shards that have no results and are not in the queue, and after them a job that merges;
/// their numbers. Throws BadInput with Slurm's own words where it refuses.
std::vector<int> SubmitOpen(const Plan& plan);

}  // namespace warmjoint
