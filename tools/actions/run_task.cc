#include "tools/actions/run_task.h"

#include <algorithm>
#include <thread>

#include "models/foundation/atomic_file.h"
#include "sim/plant/plant.h"
#include "tools/board/format_board.h"
#include "tools/suite/describe_run.h"
#include "tools/suite/engine.h"
#include "tools/suite/prepare_identifiers.h"

namespace warmjoint {
namespace {

/// A resumed run takes its own copy of the suite; one with a person's changes is left as it is.
void RefuseEditedCopy(const RunArguments& arguments, const RunDescription& description) {
  const std::filesystem::path copy = std::filesystem::path(arguments.output) / "suite.yaml";
  std::error_code absent;
  if (!std::filesystem::equivalent(arguments.suite, copy, absent)) return;
  if (ReadWholeFile(copy) == description.suite_yaml) return;
  Refuse({arguments.suite},
         "is the run's own copy, which a run writes anew, and holds more than that; name another "
         "file, or another -o");
}

void RequireWithin(std::optional<std::uint64_t> given, std::uint64_t most, const char* option) {
  // what is not given is within any bounds
  if (!given || (*given >= 1 && *given <= most)) return;
  Refuse({option}, "is {}; it must be from 1 to {}", *given, most);
}

/// Refuses more results than a run can keep count of.
void RefuseTooMany(const Suite& suite, const Shard& shard, const Place& place) {
  constexpr double most = 1e8;  // some 10 GB of memory while the run goes on
  const int realizations = shard.End(suite.realizations) - shard.First(suite.realizations);
  const double results = static_cast<double>(realizations) * suite.variants() *
                         static_cast<double>(suite.identifiers.size());
  if (results <= most) return;
  Refuse(place,
         "asks for {:g} results ({} realizations of {} variants by {} identifiers, in {} shards); "
         "{:g} at most: give fewer realizations, or more shards",
         results, suite.realizations, suite.variants(), suite.identifiers.size(), shard.count,
         most);
}

}  // namespace

RunTask PrepareRun(const RunArguments& arguments) {
  RequireWithin(arguments.jobs, kMostJobs, "--jobs");
  RequireWithin(arguments.realizations, kMostRealizations, "--realizations");
  RunTask task;
  task.suite = ResolveSuite(arguments);
  task.identifiers =
      PrepareIdentifiers(task.suite.identifiers, {arguments.suite}, arguments.confinement);
  task.shard = ReadShard(arguments.shard);
  // a thread for each core where nothing else is said
  const std::uint64_t cores = std::max(1u, std::thread::hardware_concurrency());
  task.jobs = static_cast<int>(arguments.jobs.value_or(cores));
  RefuseTooMany(task.suite, task.shard, {arguments.suite});
  // a variant that cannot be simulated is found before the run begins
  for (int i = 0; i < task.suite.variants(); ++i) MakePlant(VariantScenario(task.suite, i));

  // what a stored run has to agree with before it goes on
  task.description = Describe(task.suite);
  RefuseEditedCopy(arguments, task.description);
  return task;
}

RunEnding EndRun(RunStore& store) {
  WriteTables(store);
  return EndingOf(store);
}

RunEnding Run(const RunArguments& arguments, const std::function<void(int, int)>& watch) {
  const RunTask task = PrepareRun(arguments);
  RunStore store = RunStore::CreateOrResume(arguments.output, task.description);
  // without a listener nothing is said
  RunOptions options{task.jobs, task.shard, arguments.keep, [](int, int) {}};
  if (watch) options.watch = watch;
  const RunOutcome outcome = RunSuite(task.suite, task.identifiers, options, store);
  RunEnding ending = EndRun(store);
  ending.realizations = outcome.finished;
  ending.not_following = outcome.following.Words(task.suite);
  return ending;
}

}  // namespace warmjoint
