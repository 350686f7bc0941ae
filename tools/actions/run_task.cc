#include "tools/actions/run_task.h"

#include <algorithm>
#include <map>
#include <set>
#include <thread>

#include "models/foundation/atomic_file.h"
#include "sim/plant/plant.h"
#include "tools/board/write_tables.h"
#include "tools/suite/describe_run.h"
#include "tools/suite/memory_of_work.h"

namespace warmjoint::inline tools {
namespace {

/// Whether an identifier answered, be it with a verdict.
bool IsAnswer(const Result& result) {
  static const std::set<std::string> none{"crashed", "timeout", "bad_answer", "not_simulated"};
  return !none.contains(result.status);
}

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

}  // namespace

RunTask PrepareRun(const RunArguments& arguments) {
  RunTask task;
  task.suite = ResolveSuite(arguments);
  task.identifiers = PrepareIdentifiers(task.suite.identifiers, {arguments.suite});
  task.shard = ReadShard(arguments.shard);
  const std::uint64_t cores = std::max(1u, std::thread::hardware_concurrency());
  task.jobs = static_cast<int>(arguments.jobs.value_or(cores));
  RequireMemoryFor(task.suite, task.shard, task.jobs, arguments.suite);
  for (int i = 0; i < task.suite.variants(); ++i) MakePlant(VariantScenario(task.suite, i));

  task.description = Describe(task.suite);
  RefuseEditedCopy(arguments, task.description);
  return task;
}

RunEnding EndRun(RunStore& store) {
  store.Settle();
  RunEnding ending;
  ending.results = WriteTables(store);

  // by position of the identifier: who answered, and the first failure of each
  std::set<int> answered;
  std::map<int, std::string> first;
  store.ForEachUnit([&](const std::vector<Result>& unit) {
    for (const Result& result : unit) {
      if (IsAnswer(result)) answered.insert(result.identifier);
      if (result.status == "ok") continue;
      ++ending.failed;
      first.emplace(result.identifier, result.message);
    }
  });

  const std::vector<std::string> labels = store.ReadDescription().identifiers;
  for (const auto& [identifier, message] : first) {
    if (answered.contains(identifier)) continue;
    ending.silent.emplace_back(labels[static_cast<std::size_t>(identifier)], message);
  }
  return ending;
}

}  // namespace warmjoint::inline tools
