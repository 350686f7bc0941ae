// How far a planned run is, from its files alone.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/cluster/plan.h"
#include "tools/cluster/submissions.h"

namespace warmjoint::inline tools {

/// A shard that needs a person, or will.
struct ShardWords {
  int shard = 0;
  std::string words;
};

struct RunStatus {
  std::string suite;
  int finished = 0;  // units (realizations of all variants) in the run
  int total = 0;
  int realizations = 0;  // of each variant
  bool merged = false;
  std::vector<int> done, running, waiting, missing, failed;  // numbers of shards, ascending
  std::map<std::string, int> failures;                       // of identifiers: status: count
  double rate = 0;                                           // units a second of what runs
  std::optional<double> seconds_left;                        // empty where nothing runs
  std::vector<ShardWords> last_words;                        // of failed and missing shards
};

/// queue: what Slurm says waits and runs; without it a shard runs as long as its task gives signs of
/// life, and what waits counts as missing.
RunStatus StatusOf(const std::filesystem::path& run, const Plan& plan,
                   const std::optional<QueuedShards>& queue);

std::string StatusText(const std::filesystem::path& run, const RunStatus& status);
nlohmann::json StatusJson(const RunStatus& status);

}  // namespace warmjoint::inline tools
