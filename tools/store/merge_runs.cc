#include "tools/store/merge_runs.h"

#include "models/foundation/atomic_directory.h"
#include "models/foundation/bad_input.h"
#include "tools/store/export_csv.h"
#include "tools/store/stored_suite.h"

namespace warmjoint::inline tools {
namespace {

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
                    const std::filesystem::path& directory, const MergeOptions& options) {
  // all shards must be of one run, and as they were stored, before anything is written
  const RunDescription description =
      RunStore::OpenToRead(shards.front(), options.access).ReadDescription();
  const Suite suite = StoredSuite(RunStore::OpenToRead(shards.front(), options.access));
  for (const auto& path : shards) {
    const RunStore shard = RunStore::OpenToRead(path, options.access);
    RefuseDifferentRun(description, shard.ReadDescription(), {path.string()});
    shard.Verify();
  }

  AtomicDirectory whole(directory, {});
  MergedRun outcome;
  {
    RunStore merged = RunStore::CreateOrResume(whole.temporary(), description);
    merged.Gather(shards, options.overlap);
    outcome.results = ExportResults(merged);
    outcome.missing = MissingUnits(suite, merged);
    outcome.units =
        static_cast<std::size_t>(suite.realizations) * static_cast<std::size_t>(suite.variants());
  }
  whole.Commit();
  return outcome;
}

}  // namespace warmjoint::inline tools
