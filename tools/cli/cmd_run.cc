// warmjoint run SUITE.yaml: all realizations, all identifiers, on all cores.
#include <fmt/format.h>

#include <limits>
#include <memory>

#include "scenarios/suite.h"
#include "tools/actions/run_task.h"
#include "tools/actions/suite_names.h"
#include "tools/cli/command.h"
#include "tools/cli/end_of_run.h"
#include "tools/cli/run_in_shards.h"
#include "tools/cli/typed_options.h"
#include "tools/cluster/plan.h"
#include "tools/suite/engine.h"
#include "tools/suite/external_identifier.h"
#include "tools/suite/interrupt.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

constexpr std::uint64_t kLargestSeed = std::numeric_limits<std::uint64_t>::max();

ExitStatus RunCommand(RunArguments arguments) {
  // a suite by its name or file, in shards or here
  arguments.suite = FindSuite(arguments.suite);
  if (arguments.in_shards()) return RunInShards(arguments);
  RefuseShardOptions(arguments);

  const RunTask task = PrepareRun(arguments);
  if (HasPlan(arguments.output)) return RunPlannedShard(arguments, task);
  RunStore store = RunStore::CreateOrResume(arguments.output, task.description);
  ReportConfinement(task.suite.identifiers, {arguments.suite, arguments.output},
                    arguments.confinement);
  // interrupts end the run after the realizations in hand
  CatchInterrupts();
  const RunOutcome outcome =
      RunSuite(task.suite, task.identifiers, {task.jobs, task.shard, arguments.keep}, store);
  NoticeNotFollowing(outcome.following, task.suite);
  if (outcome.interrupted) {
    Say(stderr, "interrupted: {} of {} realizations are kept; the same command goes on\n",
        outcome.finished, outcome.total);
    return ExitStatus::interrupted;
  }
  // tables and words of a run that is over; a shard says little by itself
  return PrintEnding(store.directory(), EndRun(store),
                     task.shard.IsWhole() ? RunPart::whole : RunPart::shard);
}

}  // namespace

Command AddRunCommand(CLI::App& program) {
  auto arguments = std::make_shared<RunArguments>();
  CLI::App* parser = program.add_subcommand(
      "run", "Run a suite: realizations, identifiers, scores; resumes where it stopped");
  // what is run, and where it is kept
  parser
      ->add_option("SUITE", arguments->suite, "suite file (YAML), or one of: warmjoint list suites")
      ->type_name("SUITE")
      ->required();
  parser->add_option("-o,--output", arguments->output, "run directory, made or resumed")
      ->type_name("DIR")
      ->required();

  // what changes of the suite
  AddWholeNumber(*parser, "--jobs", arguments->jobs, 1, kMostJobs,
                 "threads; default: one for each core");
  AddWholeNumber(*parser, "--realizations", arguments->realizations, 1, kMostRealizations,
                 "instead of the suite's");
  AddWholeNumber(*parser, "--seed", arguments->seed, 0, kLargestSeed, "instead of the suite's");
  parser
      ->add_option("--identifier", arguments->identifiers,
                   "only this one of the suite, another one with its defaults, or your own as "
                   "'name=command {recording} {estimate}'; +NAME or '+name=command ...' adds to "
                   "those of the suite; repeatable")
      ->type_name("IDENTIFIER");

  // which part of it, and what commands may do
  parser->add_option("--shard", arguments->shard, "part i of n, to be merged later: i/n")
      ->type_name("TEXT")
      ->capture_default_str();
  parser->add_flag("--allow-commands", arguments->allow_commands,
                   "run the commands that the suite names as identifiers");
  parser->add_flag_callback(
      "--unconfined", [arguments] { arguments->confinement = Confinement::none; },
      "run commands of identifiers without the sandbox: where the kernel has none, or they need a "
      "GPU");
  parser->add_flag("--keep-recordings", arguments->keep, "recordings (HDF5) into RUN/recordings");
  AddShardOptions(*parser, *arguments);
  return {parser, [arguments] { return RunCommand(*arguments); }};
}

}  // namespace warmjoint
