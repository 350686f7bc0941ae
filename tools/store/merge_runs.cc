#include "tools/store/merge_runs.h"

#include <cmath>
#include <limits>

#include "models/foundation/atomic_directory.h"
#include "models/foundation/bad_input.h"
#include "tools/store/export_csv.h"
#include "tools/store/stored_suite.h"

namespace warmjoint::inline tools {
namespace {

/// Whole units of one shard, with their traces, as RunStore::Write takes them.
std::vector<Realization> ReadRealizations(const RunStore& shard) {
  const std::map<Unit, double> seconds = shard.ReadSimulationSeconds();
  std::vector<Realization> realizations;
  for (Result& result : shard.ReadResults()) {
    const Unit unit{result.variant, result.realization};
    result.trace = shard.ReadTrace(unit, result.identifier);
    if (realizations.empty() || realizations.back().unit != unit) {
      const auto known = seconds.find(unit);
      const double unknown = std::numeric_limits<double>::quiet_NaN();
      realizations.push_back({unit, known == seconds.end() ? unknown : known->second, {}});
    }
    realizations.back().results.push_back(std::move(result));
  }
  return realizations;
}

void RefuseOverlap(const RunStore& merged, const RunStore& shard) {
  const std::set<Unit> finished = merged.Finished();
  for (const Unit& unit : shard.Finished()) {
    if (!finished.count(unit)) continue;
    Refuse({shard.directory().string()},
           "holds realization {}, which another shard holds as well; merge each shard once",
           unit.realization);
  }
}

/// Units of the run that `merged` lacks.
std::set<Unit> MissingUnits(const Suite& suite, const RunStore& merged) {
  const std::set<Unit> finished = merged.Finished();
  std::set<Unit> missing;
  for (int variant = 0; variant < suite.variants(); ++variant) {
    for (int realization = 0; realization < suite.realizations; ++realization) {
      if (!finished.contains({variant, realization})) missing.insert({variant, realization});
    }
  }
  return missing;
}

}  // namespace

MergedRun MergeRuns(const std::vector<std::filesystem::path>& shards,
                    const std::filesystem::path& directory) {
  // all shards must be of one run before anything is written
  const RunStore first = RunStore::OpenToRead(shards.front());
  const RunDescription description = first.ReadDescription();
  const Suite suite = StoredSuite(first);
  for (const auto& path : shards) {
    RefuseDifferentRun(description, RunStore::OpenToRead(path).ReadDescription(), {path.string()});
  }

  AtomicDirectory whole(directory, {});
  MergedRun outcome;
  {
    RunStore merged = RunStore::CreateOrResume(whole.temporary(), description);
    for (const auto& path : shards) {
      const RunStore shard = RunStore::OpenToRead(path);
      RefuseOverlap(merged, shard);
      merged.Write(ReadRealizations(shard));
    }
    merged.Settle();
    outcome.results = ExportResults(merged).size();
    outcome.missing = MissingUnits(suite, merged);
    outcome.units =
        static_cast<std::size_t>(suite.realizations) * static_cast<std::size_t>(suite.variants());
  }
  whole.Commit();
  return outcome;
}

}  // namespace warmjoint::inline tools
