// warmjoint run SUITE.yaml: all realizations, all identifiers, on all cores.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <thread>

#include "sim/plant/plant.h"
#include "tools/cli/command.h"
#include "tools/store/export_csv.h"
#include "tools/store/run_store.h"
#include "tools/suite/choose_identifiers.h"
#include "tools/suite/describe_run.h"
#include "tools/suite/engine.h"
#include "tools/suite/interrupt.h"

namespace warmjoint::inline tools {
namespace {

struct RunArguments {
  std::string suite;
  std::string output;
  int jobs = 0;
  std::optional<int> realizations;
  std::optional<std::uint64_t> seed;
  std::vector<std::string> identifiers;
  std::string shard = "1/1";
  bool keep = false;
};

/// The suite with what the command line changes.
Suite ResolveSuite(const RunArguments& arguments) {
  Suite suite = ReadSuite(arguments.suite);
  if (arguments.realizations) suite.realizations = *arguments.realizations;
  if (arguments.seed) suite.scenario.seed = *arguments.seed;
  suite.identifiers = ChooseIdentifiers(suite.identifiers, arguments.identifiers);
  return suite;
}

/// Whether an identifier answered, be it with a verdict.
bool IsAnswer(const Result& result) {
  static const std::set<std::string> none{"crashed", "timeout", "bad_answer", "not_simulated"};
  return !none.contains(result.status);
}

/// Verdicts are results: a suite that ends in failures alone is done. One without a single answer
/// is not.
ExitStatus Finish(const RunStore& store) {
  const std::vector<Result> results = ExportResults(store);
  const auto failed = std::count_if(results.begin(), results.end(),
                                    [](const Result& result) { return result.status != "ok"; });
  fmt::print("{}: {} results, {} of them failures; see: warmjoint compare {}\n",
             store.directory().string(), results.size(), failed, store.directory().string());
  const bool nothing = std::none_of(results.begin(), results.end(), IsAnswer);
  if (nothing) fmt::print(stderr, "no identifier answered; the first: {}\n", results[0].message);
  return nothing ? ExitStatus::nothing_trustworthy : ExitStatus::done;
}

ExitStatus Run(const RunArguments& arguments) {
  // everything that can be refused is, before anything is written
  const Suite suite = ResolveSuite(arguments);
  const std::vector<PreparedIdentifier> identifiers =
      PrepareIdentifiers(suite.identifiers, {arguments.suite});
  for (int i = 0; i < suite.variants(); ++i) MakePlant(VariantScenario(suite, i));

  const Shard shard = ReadShard(arguments.shard);
  RunStore store = RunStore::CreateOrResume(arguments.output, Describe(suite));
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  CatchInterrupts();
  const RunOutcome outcome =
      RunSuite(suite, identifiers,
               {arguments.jobs > 0 ? arguments.jobs : cores, shard, arguments.keep}, store);
  if (outcome.interrupted) {
    fmt::print(stderr, "interrupted: {} of {} realizations are kept; the same command goes on\n",
               outcome.finished, outcome.total);
    return ExitStatus::interrupted;
  }
  return Finish(store);
}

}  // namespace

Command AddRunCommand(CLI::App& program) {
  auto arguments = std::make_shared<RunArguments>();
  CLI::App* parser = program.add_subcommand(
      "run", "Run a suite: realizations, identifiers, scores; resumes where it stopped");
  parser->add_option("SUITE", arguments->suite, "suite file (YAML)")->required();
  parser->add_option("-o,--output", arguments->output, "run directory, made or resumed")
      ->required();
  parser->add_option("--jobs", arguments->jobs, "threads; default: one for each core")
      ->check(CLI::PositiveNumber);
  parser->add_option("--realizations", arguments->realizations, "instead of the suite's")
      ->check(CLI::PositiveNumber);
  parser->add_option("--seed", arguments->seed, "instead of the suite's");
  parser->add_option("--identifier", arguments->identifiers,
                     "only this one of the suite, another one with its defaults, or your own as\n"
                     "'name=command {recording} {estimate}'; repeatable");
  parser->add_option("--shard", arguments->shard, "part i of n, to be merged later: i/n")
      ->capture_default_str();
  parser->add_flag("--keep-recordings", arguments->keep, "recordings (HDF5) into RUN/recordings");
  return {parser, [arguments] { return Run(*arguments); }};
}

}  // namespace warmjoint::inline tools
