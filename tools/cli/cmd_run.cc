// warmjoint run SUITE.yaml: all realizations, all identifiers, on all cores.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include "models/foundation/atomic_file.h"
#include "models/foundation/excerpt.h"
#include "scenarios/parse_suite.h"
#include "sim/plant/plant.h"
#include "tools/cli/command.h"
#include "tools/cli/run_arguments.h"
#include "tools/cli/run_in_shards.h"
#include "tools/cli/whole_number.h"
#include "tools/store/export_csv.h"
#include "tools/store/run_store.h"
#include "tools/suite/arithmetic.h"
#include "tools/suite/describe_run.h"
#include "tools/suite/engine.h"
#include "tools/suite/external_identifier.h"
#include "tools/suite/interrupt.h"
#include "tools/suite/memory_of_work.h"
#include "tools/suite/wall.h"

namespace warmjoint::inline tools {
namespace {

constexpr std::uint64_t kMostJobs = 1024;
constexpr std::uint64_t kLargestSeed = std::numeric_limits<std::uint64_t>::max();

/// Whether an identifier answered, be it with a verdict.
bool IsAnswer(const Result& result) {
  static const std::set<std::string> none{"crashed", "timeout", "bad_answer", "not_simulated"};
  return !none.contains(result.status);
}

/// What is said of a run at its end.
struct Ending {
  std::size_t failed = 0;
  std::set<int> answered;            // positions of identifiers
  std::map<int, std::string> first;  // the first failure of each
};

Ending EndingOf(const RunStore& store) {
  Ending ending;
  store.ForEachUnit([&](const std::vector<Result>& unit) {
    for (const Result& result : unit) {
      if (result.status == "ok") continue;
      ++ending.failed;
      ending.first.emplace(result.identifier, result.message);
    }
    for (const Result& result : unit) {
      if (IsAnswer(result)) ending.answered.insert(result.identifier);
    }
  });
  return ending;
}

/// Verdicts are results: a suite that ends in failures alone is done. One with an identifier that
/// never answered is not; of a shard, which may hold few realizations or none, only the whole says.
ExitStatus Finish(RunStore& store, const Shard& shard) {
  store.Settle();
  const std::size_t results = ExportResults(store);
  const Ending ending = EndingOf(store);
  fmt::print("{}: {} results, {} of them failures; see: warmjoint compare {}\n",
             store.directory().string(), results, ending.failed, store.directory().string());

  bool silent = false;
  const std::vector<std::string> labels = store.ReadDescription().identifiers;
  for (const auto& [identifier, message] : ending.first) {
    if (ending.answered.contains(identifier)) continue;
    silent = true;
    fmt::print(stderr, "{} answered in no realization; the first time: {}\n",
               Excerpt(labels[static_cast<std::size_t>(identifier)]),
               Excerpt(message, kLongestComplaint));
  }
  return !silent || !shard.IsWhole() ? ExitStatus::done : ExitStatus::no_answer;
}

/// Says what keeps commands of others from the truth, where there are any.
void TellWall(const Suite& suite, const std::vector<std::filesystem::path>& secrets) {
  bool told = false;
  for (const SuiteIdentifier& identifier : suite.identifiers) {
    if (identifier.name != kExternal) continue;
    if (!std::exchange(told, true)) fmt::print(stderr, "{}\n", WallInWords());
    if (BestWall() == WallKind::none) return;
    for (const std::filesystem::path& secret : secrets) {
      if (WallHides(secret, ReadableBy(identifier))) continue;
      fmt::print(stderr, "warning: {} can read {}: it lies where the wall is open; move it\n",
                 identifier.label, secret.string());
    }
  }
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

ExitStatus Run(const RunArguments& arguments) {
  SettleArithmetic();
  if (arguments.in_shards()) return RunInShards(arguments);
  RefuseShardOptions(arguments);

  // everything that can be refused is, before anything is written
  const Suite suite = ResolveSuite(arguments);
  const std::vector<PreparedIdentifier> identifiers =
      PrepareIdentifiers(suite.identifiers, {arguments.suite});
  const Shard shard = ReadShard(arguments.shard);
  const std::uint64_t cores = std::max(1u, std::thread::hardware_concurrency());
  const auto jobs = static_cast<int>(arguments.jobs.value_or(cores));
  RequireMemoryFor(suite, shard, jobs, arguments.suite);
  for (int i = 0; i < suite.variants(); ++i) MakePlant(VariantScenario(suite, i));

  const RunDescription description = Describe(suite);
  RefuseEditedCopy(arguments, description);
  RunStore store = RunStore::CreateOrResume(arguments.output, description);
  TellWall(suite, {arguments.suite, arguments.output});
  CatchInterrupts();
  const RunOutcome outcome = RunSuite(suite, identifiers, {jobs, shard, arguments.keep}, store);
  if (outcome.interrupted) {
    fmt::print(stderr, "interrupted: {} of {} realizations are kept; the same command goes on\n",
               outcome.finished, outcome.total);
    return ExitStatus::interrupted;
  }
  return Finish(store, shard);
}

}  // namespace

Command AddRunCommand(CLI::App& program) {
  auto arguments = std::make_shared<RunArguments>();
  CLI::App* parser = program.add_subcommand(
      "run", "Run a suite: realizations, identifiers, scores; resumes where it stopped");
  parser->add_option("SUITE", arguments->suite, "suite file (YAML)")->required();
  parser->add_option("-o,--output", arguments->output, "run directory, made or resumed")
      ->required();
  AddWholeNumber(*parser, "--jobs", arguments->jobs, 1, kMostJobs,
                 "threads; default: one for each core");
  AddWholeNumber(*parser, "--realizations", arguments->realizations, 1, kMostRealizations,
                 "instead of the suite's");
  AddWholeNumber(*parser, "--seed", arguments->seed, 0, kLargestSeed, "instead of the suite's");
  parser->add_option("--identifier", arguments->identifiers,
                     "only this one of the suite, another one with its defaults, or your own as\n"
                     "'name=command {recording} {estimate}'; repeatable");
  parser
      ->add_option("--shard", arguments->shard,
                   "part i of n, or realizations a to b - 1, to be merged later: i/n or\n"
                   "a:b")
      ->capture_default_str();
  parser->add_flag("--allow-commands", arguments->allow_commands,
                   "run the commands that the suite names as identifiers");
  parser->add_flag("--shell", arguments->shell,
                   "give commands of identifiers to /bin/sh, instead of as lists of arguments");
  parser->add_flag("--keep-recordings", arguments->keep, "recordings (HDF5) into RUN/recordings");
  AddShardOptions(*parser, *arguments);
  return {parser, [arguments] { return Run(*arguments); }};
}

}  // namespace warmjoint::inline tools
