// How a run is parted and what each part is: plan.json, which people may read and edit.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace warmjoint::inline tools {

/// Realizations first .. end - 1 of a suite, in all its variants; none where both are equal.
struct PlannedShard {
  int first = 0;
  int end = 0;

  int size() const { return end - first; }
};

/// A file that has to be the same wherever a shard is computed.
struct PinnedFile {
  std::string path;
  std::string sha256;  // empty: there is none
};

/// What a suite from elsewhere may do on the machines that carry it out, as the person agreed to.
enum class Consent { none, commands, unconfined };

struct Plan {
  std::string id;          // drawn; keeps what this plan leaves on machines apart from other plans'
  std::string suite_yaml;  // fully resolved
  std::string directory;   // where relative names in the suite start
  std::vector<std::pair<std::string, std::string>> versions;  // of all that computes, by name
  PinnedFile program, plugin;
  Consent consent = Consent::none;
  int jobs = 1;                    // threads of a task
  double probe_seconds = 0;        // for one realization in all variants, on one thread
  double checkpoint_seconds = 30;  // longest time between copies of a task's results into the run
  int restarts = 5;                // in a row that finish no realization; after them a shard failed
  int array_parallelism = 0;       // tasks at a time; 0: as many as the cluster starts
  std::vector<std::string> sbatch;  // key=value, handed on
  std::vector<PlannedShard> shards;
};

/// Writes RUN/slurm/plan.json.
void WritePlan(const std::filesystem::path& run, const Plan& plan);

/// Throws BadInput where there is none, and for entries that are unknown, missing or out of bounds.
Plan ReadPlan(const std::filesystem::path& run);

bool HasPlan(const std::filesystem::path& run);

/// Throws BadInput that tells what makes a plan.
void RefuseWithoutPlan(const std::filesystem::path& run);

}  // namespace warmjoint::inline tools
