// How far a planned run is.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/cluster/plan.h"
#include "tools/cluster/slurm.h"

namespace warmjoint {

struct RunStatus {
  std::string suite;
  int finished = 0;  // units (realizations of all variants) of the shards that are done
  int total = 0;
  bool merged = false;
  std::vector<int> done, running, waiting, missing;  // numbers of shards, ascending
};

/// By the results that lie in the run and by what Slurm's queue says; without it nothing runs or waits.
RunStatus StatusOf(const Plan& plan, const std::optional<QueuedShards>& queue);

std::string StatusText(const Plan& plan, const RunStatus& status);
nlohmann::json StatusJson(const RunStatus& status);

}  // namespace warmjoint
