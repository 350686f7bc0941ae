#include "tools/store/merge_runs.h"

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "tools/store/stored_suite.h"

namespace warmjoint::inline tools {
namespace {

/// Units of the run that `merged` lacks.
std::set<Unit> MissingUnits(const Suite& suite, const RunStore& merged) {
  std::set<Unit> missing;
  const int last = suite.realizations;
  Unit next;  // the first that is not looked at yet
  // units between two finished ones are missing
  const auto skip_to = [&](Unit end) {
    while (next < end) {
      if (next.realization < last) missing.insert(missing.end(), next);
      next = next.realization < last ? Unit{next.variant, next.realization + 1}
                                     : Unit{next.variant + 1, 0};
    }
  };
  // finished units come in order
  merged.ForEachFinished([&](Unit unit) {
    skip_to(unit);
    ++next.realization;
  });
  skip_to({suite.variants(), 0});
  return missing;
}

}  // namespace

MergedRun MergeRuns(const std::vector<std::filesystem::path>& shards,
                    const std::filesystem::path& directory, const MergeOptions& options) {
  if (shards.empty()) Refuse({directory.string()}, "has no shards to merge; give at least one");
  // all shards must be of one run, and as they were stored, before anything is written
  const RunDescription description =
      RunStore::OpenToRead(shards.front(), options.access).ReadDescription();
  const Suite suite = StoredSuite(RunStore::OpenToRead(shards.front(), options.access));
  for (const auto& path : shards) {
    const RunStore shard = RunStore::OpenToRead(path, options.access);
    RefuseDifferentRun(description, shard.ReadDescription(), {path.string()});
    shard.Verify();
  }

  // the merged run is not seen before it is whole
  AtomicDirectory whole(directory, {});
  MergedRun outcome;
  {
    // rows of all shards, their tables, and what is still missing
    RunStore merged = RunStore::CreateOrResume(whole.temporary(), description);
    merged.Gather(shards, options.overlap);
    outcome.results = options.write_tables(merged);
    outcome.missing = MissingUnits(suite, merged);
    outcome.units =
        static_cast<std::size_t>(suite.realizations) * static_cast<std::size_t>(suite.variants());
  }
  whole.Commit();
  return outcome;
}

}  // namespace warmjoint::inline tools
