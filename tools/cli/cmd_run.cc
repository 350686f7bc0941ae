// warmjoint run SUITE.yaml: all realizations, all identifiers, on all cores.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <memory>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "scenarios/suite.h"
#include "tools/actions/run_task.h"
#include "tools/cli/command.h"
#include "tools/cli/end_of_run.h"
#include "tools/cli/typed_options.h"
#include "tools/cluster/plan.h"
#include "tools/cluster/shards.h"
#include "tools/cluster/slurm.h"
#include "tools/store/folders.h"
#include "tools/suite/engine.h"
#include "tools/suite/external_identifier.h"
#include "tools/suite/prepare_identifiers.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;

/// What each shard's `run` is told besides its part.
std::vector<std::string> ForEachShard(const RunArguments& arguments, const Suite& suite) {
  std::vector<std::string> more{"--quiet", "--jobs", std::to_string(arguments.jobs.value_or(1))};
  // commands of the plan's suite were agreed to, or named, when it was planned
  const bool commands = std::ranges::any_of(
      suite.identifiers,
      [](const SuiteIdentifier& identifier) { return identifier.name == kExternal; });
  if (commands) more.emplace_back("--allow-commands");
  if (arguments.confinement == Confinement::none) more.emplace_back("--unconfined");
  return more;
}

void RefuseOtherContent(const fs::path& run) {
  // folders of a plan may be there, results of another run not
  for (const auto& entry : fs::directory_iterator(run)) {
    const std::string name = entry.path().filename();
    if (name == "slurm" || name == ".lock") continue;
    Refuse({run.string()}, "holds '{}' and no plan; choose a new or empty directory", name);
  }
}

/// The plan that the directory holds, or a new one with its script.
Plan TakeOrMakePlan(const fs::path& run, const RunArguments& arguments) {
  // the same suite goes on by the plan that is there
  const Suite suite = ResolveSuite(arguments);
  if (HasPlan(run)) {
    Plan plan = ReadPlan(run);
    RefuseDifferentRun({plan.suite_yaml, {}}, {SuiteToYaml(suite), {}}, {run.string()});
    if (arguments.shards && *arguments.shards != static_cast<std::uint64_t>(plan.shards)) {
      Refuse({"--shards"}, "is {}; {} has {} already: leave it out, or choose a new directory",
             *arguments.shards, run.string(), plan.shards);
    }
    return plan;
  }

  // identifiers are checked now, not first by a task
  RefuseOtherContent(run);
  PrepareContestants(suite, {arguments.suite}, arguments.confinement);
  const auto jobs = static_cast<int>(arguments.jobs.value_or(1));
  const auto at_once = static_cast<int>(arguments.local_shards.value_or(1));
  const int shards = arguments.shards ? static_cast<int>(*arguments.shards)
                                      : std::max(DefaultShards(suite, jobs), at_once);
  if (arguments.slurm) RefuseLargeArray(shards);
  const Plan plan{run, SuiteToYaml(suite), suite, shards};
  WriteWholeFile(plan.script(),
                 ArrayScript(plan, arguments.sbatch, jobs, ForEachShard(arguments, suite)));
  WritePlan(plan);
  Say(stdout, "{}: {} realizations in {} shards\n", run.string(),
      suite.realizations * suite.variants(), shards);
  return plan;
}

ExitStatus Conclude(const Plan& plan) {
  // a job of the cluster may have merged them
  if (!plan.IsMerged()) MergePlanned(plan);
  return PrintEnding(plan.run, EndingOf(RunStore::OpenToRead(plan.run)), RunPart::whole);
}

ExitStatus RunHere(const Plan& plan, const RunArguments& arguments) {
  CatchInterrupts();
  const LocalEnd end = RunLocally(plan, static_cast<int>(*arguments.local_shards),
                                  ForEachShard(arguments, plan.suite));
  if (end.interrupted) {
    Say(stderr, "interrupted: {} of {} shards are finished; the same command goes on\n",
        plan.shards - plan.Open().size(), plan.shards);
    return ExitStatus::interrupted;
  }
  if (end.failed != 0) {
    Say(stderr, "shard {} of {} ended with status {}; the same command starts it again\n",
        end.failed, plan.shards, end.status);
    return static_cast<ExitStatus>(end.status > 128 ? 1 : end.status);
  }
  return Conclude(plan);
}

ExitStatus SubmitAll(const Plan& plan) {
  // what waits or runs is not submitted twice
  const std::vector<int> submitted = SubmitOpen(plan);
  if (submitted.empty()) {
    Refuse({plan.run.string()}, "is submitted already; see `warmjoint status {}`",
           plan.run.string());
  }
  Say(stdout, "submitted: shards {}; see: warmjoint status {}\n", Ranges(submitted),
      plan.run.string());
  return ExitStatus::done;
}

/// The options of a run in shards.
void AddShardOptions(CLI::App& parser, RunArguments& arguments) {
  AddValue(parser, "--shard", "TEXT", arguments.shard, "part i of n, to be merged later: i/n")
      ->capture_default_str();
  // where the shards are computed
  parser.add_flag("--slurm", arguments.slurm, "as tasks of a Slurm cluster; see `status`")
      ->group("In shards");
  AddWholeNumber(parser, "--local-shards", arguments.local_shards, 1, 1024,
                 "as processes on this machine, so many at a time")
      ->group("In shards");

  // how the run is parted, and what the cluster is told
  AddWholeNumber(parser, "--shards", arguments.shards, 1, kMostShards,
                 "number of shards; default: one for each 1000 realizations and thread")
      ->group("In shards");
  AddValue(parser, "--sbatch", "TEXT", arguments.sbatch, "key=value for sbatch")
      ->group("In shards");
  parser.add_flag("--dry-run", arguments.dry_run, "write plan and script, and submit nothing")
      ->group("In shards");
}

/// Plans the run, or takes the plan that is there, and submits it or carries it out.
ExitStatus RunInShards(const RunArguments& arguments) {
  // what does not go together
  if (arguments.slurm && arguments.local_shards) {
    Refuse({"warmjoint run"}, "give --slurm or --local-shards, not both");
  }
  if (arguments.keep || arguments.shard != "1/1") {
    Refuse({"warmjoint run"},
           "--keep-recordings and --shard do not go with --slurm and --local-shards");
  }
  CheckSbatch(arguments.sbatch);

  // the plan's folder is locked while it is made and carried out
  const fs::path run = fs::absolute(arguments.output).lexically_normal();
  fs::create_directories(run / "slurm");
  const DirectoryLock lock(run / "slurm");
  const Plan plan = TakeOrMakePlan(run, arguments);
  // people may look at it, or submit it, themselves
  if (arguments.dry_run) {
    fmt::print("{}\n", plan.script().string());
    return ExitStatus::done;
  }
  // what is there already, on the cluster, or here
  if (plan.IsMerged()) return Conclude(plan);
  return arguments.slurm ? SubmitAll(plan) : RunHere(plan, arguments);
}

/// Runs what the store lacks. An interrupt ends it after the realizations in hand. Says what commands can reach, and in how
/// many realizations the simulated joint did not follow its motion, if in any.
RunOutcome RunAndTell(const RunArguments& arguments, const RunTask& task, bool keep_recordings,
                      RunStore& store) {
  ReportConfinement(task.suite.identifiers, {arguments.suite, store.directory()},
                    arguments.confinement);
  CatchInterrupts();
  RunOutcome outcome =
      RunSuite(task.suite, task.contestants, {task.jobs, task.shard, keep_recordings}, store);
  const std::string words = outcome.following.Words(task.suite);
  if (!words.empty()) SayNotice("notice: {}\n", words);
  return outcome;
}

/// One shard of a planned run, as its tasks do it: on this machine's own disk (TMPDIR), and into RUN once
/// it is finished. One that is interrupted or killed leaves nothing and begins anew.
ExitStatus RunPlannedShard(const RunArguments& arguments, const RunTask& task) {
  // the part has to be one of the plan's
  const Plan plan = ReadPlan(arguments.output);
  const int number = task.shard.index;
  RefuseDifferentRun({plan.suite_yaml, {}}, {task.description.suite_yaml, {}}, {arguments.output});
  if (task.shard.count != plan.shards) {
    Refuse({"--shard"},
           "is {}; {} is planned in {} shards: give one of these, or go on with --slurm or "
           "--local-shards N",
           arguments.shard, arguments.output, plan.shards);
  }
  const auto say = [&](const char* what) {
    Say(stdout, "shard {} of {}: {}\n", number, plan.run.string(), what);
    return ExitStatus::done;
  };
  if (plan.IsDone(number)) return say("its results are there already");

  // SQLite is not to be trusted on network file systems: RUN gets the finished file
  const TemporaryFolder folder("shard");
  const fs::path directory = folder.path() / "run";
  {
    RunStore store = RunStore::CreateOrResume(directory, task.description);
    if (RunAndTell(arguments, task, false, store).interrupted) {
      say("interrupted; it begins anew with the same command");
      return ExitStatus::interrupted;
    }
  }
  Publish(plan, number, directory / "results.sqlite");
  return say("done");
}

constexpr std::uint64_t kLargestSeed = std::numeric_limits<std::uint64_t>::max();

ExitStatus RunCommand(RunArguments arguments) {
  // a suite by its name or file, in shards or here
  arguments.suite = FindSuite(arguments.suite);
  if (arguments.in_shards()) return RunInShards(arguments);
  if (arguments.shards || !arguments.sbatch.empty() || arguments.dry_run) {
    Refuse({"warmjoint run"},
           "--shards, --sbatch and --dry-run go with --slurm or --local-shards N");
  }

  const RunTask task = PrepareRun(arguments);
  if (HasPlan(arguments.output)) return RunPlannedShard(arguments, task);
  RunStore store = RunStore::CreateOrResume(arguments.output, task.description);
  const RunOutcome outcome = RunAndTell(arguments, task, arguments.keep, store);
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
  GiveExample(*parser, "warmjoint run table1 --realizations 20 -o runs/table1");
  // what is run, and where it is kept
  AddValue(*parser, "SUITE", "SUITE", arguments->suite,
           "suite file (YAML), or one of: warmjoint list suites")
      ->required();
  AddValue(*parser, "-o,--output", "DIR", arguments->output, "run directory, made or resumed")
      ->required();

  // what changes of the suite
  AddWholeNumber(*parser, "--jobs", arguments->jobs, 1, kMostJobs,
                 "threads; default: one for each core");
  AddWholeNumber(*parser, "--realizations", arguments->realizations, 1, kMostRealizations,
                 "instead of the suite's");
  AddWholeNumber(*parser, "--seed", arguments->seed, 0, kLargestSeed, "instead of the suite's");
  AddValue(*parser, "--identifier", "IDENTIFIER", arguments->identifiers,
           "only this one of the suite, another one with its defaults, or your own as "
           "'name=command {recording} {estimate}'; +NAME or '+name=command ...' adds to "
           "those of the suite; repeatable");

  // what commands may do
  parser->add_flag("--allow-commands", arguments->allow_commands,
                   "run the commands that the suite names as identifiers");
  parser->add_flag_callback(
      "--unconfined", [arguments] { arguments->confinement = Confinement::none; },
      "run commands of identifiers without the sandbox: where the kernel has none, or they need a "
      "GPU");
  parser->add_flag("--keep-recordings", arguments->keep, "recordings (HDF5) into RUN/recordings");
  BeginGroup(*parser, "Many machines");
  AddShardOptions(*parser, *arguments);
  return {parser, [arguments] { return RunCommand(*arguments); }};
}

}  // namespace warmjoint
