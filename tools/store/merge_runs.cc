#include "tools/store/merge_runs.h"

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"

namespace warmjoint {
namespace {

/// Units of the run that `merged` lacks.
std::set<RunUnit> MissingUnits(const RunStore& merged) {
  const std::set<RunUnit> finished = merged.Finished();
  std::set<RunUnit> missing;
  for (int variant = 0; variant < merged.suite().variants(); ++variant) {
    for (int realization = 0; realization < merged.suite().realizations; ++realization) {
      const RunUnit unit{variant, realization};
      if (!finished.contains(unit)) missing.insert(missing.end(), unit);
    }
  }
  return missing;
}

}  // namespace

MergedRun MergeRuns(const std::vector<std::filesystem::path>& shards,
                    const std::filesystem::path& directory,
                    const std::function<void(const RunStore&)>& write_tables) {
  if (shards.empty()) Refuse({directory.string()}, "has no shards to merge; give at least one");
  // all shards must be of one run, before anything is written
  const RunDescription description = RunStore::OpenToRead(shards.front()).description();
  for (const auto& path : shards) {
    RefuseDifferentRun(description, RunStore::OpenToRead(path).description(), {path.string()});
  }

  // the merged run is not seen before it is whole
  AtomicDirectory whole(directory, {});
  MergedRun outcome;
  {
    // rows of all shards, their tables, and what is still missing
    RunStore merged = RunStore::CreateOrResume(whole.temporary(), description);
    merged.Gather(shards);
    write_tables(merged);
    outcome.missing = MissingUnits(merged);
    outcome.units = static_cast<std::size_t>(merged.suite().realizations) *
                    static_cast<std::size_t>(merged.suite().variants());
  }
  whole.Commit();
  return outcome;
}

}  // namespace warmjoint
