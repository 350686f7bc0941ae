// What was submitted of a plan, and submitting more of it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/cluster/arrays.h"
#include "tools/cluster/plan.h"
#include "tools/cluster/slurm.h"

namespace warmjoint::inline tools {

/// An array that sbatch took.
struct SubmittedArray {
  std::string job;
  JobArray array;
};

/// RUN/slurm/jobs.json: all that was ever submitted of this plan.
struct Submissions {
  std::vector<SubmittedArray> arrays;
  std::vector<std::string> merges;  // jobs

  std::vector<std::string> Jobs() const;  // all of them
};

Submissions ReadSubmissions(const std::filesystem::path& run);

/// Shards that wait or run in the queue.
struct QueuedShards {
  std::vector<int> waiting, running;  // ascending
};
QueuedShards InQueue(const Submissions& submissions, const std::vector<QueuedTask>& queue);

/// Submits shards as arrays, and a job that merges once these have ended and what the queue holds of earlier ones; at
/// once where there are none. jobs.json is kept up to date after each answer. Throws BadInput where sbatch refuses,
/// naming the shards that are not submitted and those that are.
void Submit(const std::filesystem::path& run, const Plan& plan, const std::vector<int>& shards,
            const std::vector<QueuedTask>& queue);

}  // namespace warmjoint::inline tools
