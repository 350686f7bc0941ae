#include "tools/store/merge_runs.h"

#include "models/foundation/bad_input.h"

namespace warmjoint::inline tools {
namespace {

/// Whole units of one shard, with their traces, as RunStore::Write takes them.
std::vector<Realization> ReadRealizations(const RunStore& shard) {
  std::vector<Realization> realizations;
  for (Result& result : shard.ReadResults()) {
    const Unit unit{result.variant, result.realization};
    result.trace = shard.ReadTrace(unit, result.identifier);
    if (realizations.empty() || realizations.back().unit != unit) {
      realizations.push_back({unit, 0, {}});
    }
    realizations.back().results.push_back(std::move(result));
  }

  // both are in the order of units
  const std::vector<double> seconds = shard.ReadSimulationSeconds();
  for (size_t i = 0; i < std::min(seconds.size(), realizations.size()); ++i) {
    realizations[i].simulation_seconds = seconds[i];
  }
  return realizations;
}

void RefuseOverlap(const RunStore& merged, const RunStore& shard) {
  const std::set<Unit> finished = merged.Finished();
  for (const Unit& unit : shard.Finished()) {
    if (!finished.count(unit)) continue;
    Refuse({shard.directory().string()},
           "holds realization {}, which another shard or {} holds as well; merge each shard once "
           "into a new directory",
           unit.realization, merged.directory().string());
  }
}

}  // namespace

RunStore MergeRuns(const std::vector<std::filesystem::path>& shards,
                   const std::filesystem::path& directory) {
  // all shards must be of one run before anything is written
  const RunDescription description = RunStore::OpenToRead(shards.front()).ReadDescription();
  for (const auto& path : shards) {
    RefuseDifferentRun(description, RunStore::OpenToRead(path).ReadDescription(), {path.string()});
  }

  RunStore merged = RunStore::CreateOrResume(directory, description);
  for (const auto& path : shards) {
    const RunStore shard = RunStore::OpenToRead(path);
    RefuseOverlap(merged, shard);
    merged.Write(ReadRealizations(shard));
  }
  return merged;
}

}  // namespace warmjoint::inline tools
