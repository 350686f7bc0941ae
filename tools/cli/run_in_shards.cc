#include "tools/cli/run_in_shards.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "scenarios/suite.h"
#include "tools/cli/tell_run.h"
#include "tools/cli/whole_number.h"
#include "tools/cluster/batch_script.h"
#include "tools/cluster/draw_id.h"
#include "tools/cluster/gather.h"
#include "tools/cluster/local_shards.h"
#include "tools/cluster/make_plan.h"
#include "tools/cluster/run_layout.h"
#include "tools/cluster/run_status.h"
#include "tools/cluster/shard_state.h"
#include "tools/cluster/slurm.h"
#include "tools/cluster/submissions.h"
#include "tools/cluster/task.h"
#include "tools/cluster/wait_for_jobs.h"
#include "tools/store/directory_lock.h"
#include "tools/suite/describe_run.h"
#include "tools/suite/interrupt.h"
#include "tools/suite/prepare_identifiers.h"
#include "tools/terminal/say.h"
#include "tools/terminal/shell_words.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kMostShards = 1'000'000;

Consent ConsentOf(const RunArguments& arguments, const Suite& suite) {
  if (arguments.confinement == Confinement::none) return Consent::unconfined;
  // what the command line named was agreed to by naming it
  for (const SuiteIdentifier& identifier : suite.identifiers) {
    if (identifier.name == kExternal) return Consent::commands;
  }
  return arguments.allow_commands ? Consent::commands : Consent::none;
}

Plan MakePlan(const RunArguments& arguments, const Suite& suite) {
  // identifiers are checked now, not first by a task
  const std::vector<PreparedIdentifier> identifiers =
      PrepareIdentifiers(suite.identifiers, {arguments.suite}, arguments.confinement);
  Plan plan;
  plan.id = DrawId();

  // what is computed, and by what
  const RunDescription description = Describe(suite);
  plan.suite_yaml = description.suite_yaml;
  plan.versions = description.versions;
  plan.directory = fs::current_path();
  plan.program = ThisProgram();
  plan.plugin = ThisPlugin();

  // what tasks may do, and how many at a time
  plan.consent = ConsentOf(arguments, suite);
  plan.jobs = static_cast<int>(arguments.jobs.value_or(1));
  plan.array_parallelism = static_cast<int>(arguments.array_parallelism.value_or(0));
  plan.sbatch = arguments.sbatch;

  // a timed probe tells how long a shard is
  const Probe probe = ProbeSuite(suite, identifiers);
  TellNotFollowing(probe.following, description);
  plan.probe_seconds = probe.seconds;
  const int count = arguments.shards
                        ? static_cast<int>(*arguments.shards)
                        : ShardCount(suite.realizations, plan.probe_seconds, plan.jobs);
  plan.shards = PartEvenly(0, suite.realizations, count);
  return plan;
}

void RefuseOtherContent(const fs::path& run) {
  // folders of a plan may be there, results of another run not
  for (const auto& entry : fs::directory_iterator(run)) {
    const std::string name = entry.path().filename();
    if (name == "slurm" || name == ".lock") continue;
    Refuse({run.string()}, "holds '{}' and no plan; choose a new or empty directory", name);
  }
}

/// Tells which options ask for another plan than the one that is there, which stays.
void TellOtherPlan(const Plan& plan, const RunArguments& arguments, const fs::path& run) {
  // each option that was given, beside what the plan has
  std::vector<std::string> others;
  const auto compare = [&](const char* option, const std::optional<std::uint64_t>& asked,
                           std::uint64_t planned) {
    if (!asked || *asked == planned) return;
    others.push_back(fmt::format("{} {} asked, {} planned", option, *asked, planned));
  };
  compare("--shards", arguments.shards, plan.shards.size());
  compare("--jobs", arguments.jobs, static_cast<std::uint64_t>(plan.jobs));
  compare("--array-parallelism", arguments.array_parallelism,
          static_cast<std::uint64_t>(plan.array_parallelism));
  if (!arguments.sbatch.empty() && arguments.sbatch != plan.sbatch) {
    others.push_back(fmt::format("--sbatch {} asked, {} planned", fmt::join(arguments.sbatch, ", "),
                                 plan.sbatch.empty() ? "none" : JoinCommand(plan.sbatch)));
  }
  if (others.empty()) return;
  SayNotice("notice: {} stays as it is ({}); choose a new directory for another plan\n",
            PlanFile(run).string(), fmt::join(others, "; "));
}

/// The plan that the directory holds, which a person may have edited, or a new one.
Plan TakeOrMakePlan(const fs::path& run, const RunArguments& arguments) {
  // the same suite goes on by the plan that is there
  const Suite suite = ResolveSuite(arguments);
  if (HasPlan(run)) {
    Plan plan = ReadPlan(run);
    RefuseDifferentRun({plan.suite_yaml, {}, {}, {}}, {SuiteToYaml(suite), {}, {}, {}},
                       {run.string()});
    TellOtherPlan(plan, arguments, run);
    return plan;
  }

  // a new plan behind the scripts that people may edit: a directory with a plan has them
  RefuseOtherContent(run);
  const Plan plan = MakePlan(arguments, suite);
  WriteWholeFile(PlanFolder(run) / "array.sbatch", ArrayScript(plan, run, MostIndices()));
  WriteWholeFile(PlanFolder(run) / "merge.sbatch", MergeScript(plan, run));
  WritePlan(run, plan);

  // what was planned, before anything starts
  const auto largest = std::ranges::max_element(plan.shards, {}, &PlannedShard::size);
  const double longest = plan.probe_seconds / plan.jobs * largest->size();
  fmt::print("{}: {} realizations in {} shards of about {:.3g} s ({:.3g} s each, measured)\n",
             PlanFile(run).string(), suite.realizations, plan.shards.size(), longest,
             plan.probe_seconds);
  return plan;
}

/// Numbers of the shards that are not done. Who starts again by hand gives failed ones their starts back.
std::vector<int> OpenShards(const fs::path& run, const Plan& plan) {
  for (const int number : StatusOf(run, plan, std::nullopt).failed) {
    Forgive(ShardFolder(run, number));
  }
  // nobody asks a queue, so that what waits counts as missing
  const RunStatus status = StatusOf(run, plan, std::nullopt);
  std::vector<int> open = status.missing;
  open.insert(open.end(), status.running.begin(), status.running.end());
  std::sort(open.begin(), open.end());
  return open;
}

ExitStatus Conclude(const fs::path& run, const Plan& plan) {
  // a job of the cluster may have merged them
  if (!fs::exists(run / "results.sqlite")) MergePlanned(run, plan);
  return TellEnding(run, EndingOf(RunStore::OpenToRead(run)), RunPart::whole);
}

ExitStatus RunHere(const fs::path& run, const Plan& plan, int at_once) {
  // this machine must give the bits that the plan's would
  RefuseOtherMachine(plan, run);
  CatchInterrupts();
  // unfinished shards go on with the same command
  if (!RunLocally(run, plan, OpenShards(run, plan), at_once)) {
    fmt::print(stderr, "interrupted: {}the same command goes on\n",
               StatusText(run, StatusOf(run, plan, std::nullopt)));
    return ExitStatus::interrupted;
  }
  return Conclude(run, plan);
}

ExitStatus SubmitAll(const fs::path& run, const Plan& plan, const RunArguments& arguments) {
  // twice submitted would be twice computed
  const Submissions before = ReadSubmissions(run);
  if (!before.arrays.empty()) {
    Refuse({run.string()},
           "is submitted already (jobs {}); see `warmjoint status {}`, which submits with "
           "--resubmit what is missing",
           fmt::join(before.Jobs(), ", "), run.string());
  }

  // all open shards, as arrays with a job that merges
  Submit(run, plan, OpenShards(run, plan), {});
  fmt::print("submitted as jobs {}; see: warmjoint status {}\n",
             fmt::join(ReadSubmissions(run).Jobs(), ", "), run.string());

  // who waits also sees the end
  if (!arguments.wait) return ExitStatus::done;
  CatchInterrupts();
  if (!WaitForJobs(run, plan)) return ExitStatus::interrupted;
  return Conclude(run, plan);
}

}  // namespace

void AddShardOptions(CLI::App& parser, RunArguments& arguments) {
  // where the tasks run
  parser.add_flag("--slurm", arguments.slurm, "as tasks of a Slurm cluster; see `status`")
      ->group("In shards");
  AddWholeNumber(parser, "--local-shards", arguments.local_shards, 1, 1024,
                 "as tasks on this machine, so many at a time")
      ->group("In shards");

  // how the run is parted, and what the cluster is told
  AddWholeNumber(parser, "--shards", arguments.shards, 1, kMostShards,
                 "number of shards; default: of about 15 minutes each, by a timed probe")
      ->group("In shards");
  parser.add_option("--sbatch", arguments.sbatch, "key=value for sbatch")
      ->type_name("TEXT")
      ->group("In shards");
  AddWholeNumber(parser, "--array-parallelism", arguments.array_parallelism, 1, kMostShards,
                 "tasks at a time")
      ->group("In shards");

  // how far this command goes
  parser.add_flag("--dry-run", arguments.dry_run, "write plan and scripts, and submit nothing")
      ->group("In shards");
  parser.add_flag("--wait", arguments.wait, "until all tasks have ended, and merge")
      ->group("In shards");
}

void RefuseShardOptions(const RunArguments& arguments) {
  const bool given = arguments.shards || !arguments.sbatch.empty() || arguments.array_parallelism ||
                     arguments.dry_run || arguments.wait;
  if (!given) return;
  Refuse({"warmjoint run"},
         "--shards, --sbatch, --array-parallelism, --dry-run and --wait go with --slurm or "
         "--local-shards N");
}

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
  fs::create_directories(PlanFolder(run));
  const DirectoryLock lock(PlanFolder(run));
  const Plan plan = TakeOrMakePlan(run, arguments);
  // people may look at it, or submit it, themselves
  if (arguments.dry_run) {
    fmt::print("{}\n{}", (PlanFolder(run) / "array.sbatch").string(), ParallelRecipe(plan, run));
    return ExitStatus::done;
  }
  // what is there already, on the cluster, or here
  if (fs::exists(run / "results.sqlite")) return Conclude(run, plan);
  if (arguments.slurm) return SubmitAll(run, plan, arguments);
  return RunHere(run, plan, static_cast<int>(*arguments.local_shards));
}

}  // namespace warmjoint::inline tools
