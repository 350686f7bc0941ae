// warmjoint status RUN: which shards of a planned run lack results; --resubmit starts these again.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "tools/cli/command.h"
#include "tools/cli/typed_options.h"
#include "tools/cluster/slurm.h"
#include "tools/store/folders.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

struct StatusArguments {
  std::string run;
  std::string format = "text";
  bool resubmit = false;
};

struct RunStatus {
  std::string suite;
  int finished = 0;  // units (realizations of all variants) of the shards that are done
  int total = 0;
  bool merged = false;
  std::vector<int> done, running, waiting, missing;  // numbers of shards, ascending
};

/// By the results that lie in the run and by what Slurm's queue says; without it nothing runs or waits.
RunStatus StatusOf(const Plan& plan, const std::optional<QueuedShards>& queue) {
  RunStatus status;
  status.suite = plan.suite.name;
  status.merged = plan.IsMerged();
  for (int number = 1; number <= plan.shards; ++number) {
    status.total += plan.Units(number);
    // results first, then what the queue says, then what is left
    if (plan.IsDone(number)) {
      status.done.push_back(number);
      status.finished += plan.Units(number);
    } else if (queue && std::ranges::binary_search(queue->running, number)) {
      status.running.push_back(number);
    } else if (queue && std::ranges::binary_search(queue->waiting, number)) {
      status.waiting.push_back(number);
    } else {
      status.missing.push_back(number);
    }
  }
  return status;
}

std::string StatusText(const Plan& plan, const RunStatus& status) {
  std::string text = fmt::format("{}: {} of {} realizations{}\n", status.suite, status.finished,
                                 status.total, status.merged ? ", merged" : "");
  text += fmt::format("shards: {} done, {} running, {} waiting, {} missing\n", status.done.size(),
                      status.running.size(), status.waiting.size(), status.missing.size());
  // what a person has to do
  const std::string run = plan.run.string();
  if (!status.missing.empty()) {
    text += fmt::format(
        "missing: {}\nthey were not started, or ended without results: see {}/log. `warmjoint "
        "status {} --resubmit` submits them; without Slurm `run --local-shards N` goes on\n",
        Ranges(status.missing), plan.folder().string(), run);
  } else if (!status.merged && status.finished == status.total) {
    text += fmt::format("all is there: warmjoint merge {}\n", run);
  }
  return text;
}

nlohmann::json StatusJson(const RunStatus& status) {
  return {{"suite", status.suite},
          {"realizations", {{"finished", status.finished}, {"total", status.total}}},
          {"merged", status.merged},
          {"shards",
           {{"done", status.done},
            {"running", status.running},
            {"waiting", status.waiting},
            {"missing", status.missing}}}};
}

/// Starts again what is lost, and says what it was. Nobody else may plan or submit meanwhile.
void Resubmit(const Plan& plan) {
  const DirectoryLock lock(plan.folder());
  const std::vector<int> again = SubmitOpen(plan);
  Say(stderr, "{}\n",
      again.empty() ? "nothing is missing" : "submitted again: shards " + Ranges(again));
}

ExitStatus ShowStatus(const StatusArguments& arguments) {
  const Plan plan = ReadPlan(arguments.run);
  if (arguments.resubmit) Resubmit(plan);
  const RunStatus status = StatusOf(plan, AskQueue(plan));
  if (arguments.format == "json") {
    fmt::print("{}\n", StatusJson(status).dump(2));
  } else {
    Say(stdout, "{}", StatusText(plan, status));
  }
  return ExitStatus::done;
}

}  // namespace

Command AddStatusCommand(CLI::App& program) {
  auto arguments = std::make_shared<StatusArguments>();
  CLI::App* parser = program.add_subcommand("status", "Which shards of a planned run have results");
  GiveExample(*parser, "warmjoint status runs/planned");
  AddValue(*parser, "RUN", "RUN", arguments->run, "directory of `run --slurm` or --local-shards")
      ->required();
  AddChoice(*parser, "--format", arguments->format, {"text", "json"}, "of what is printed");
  parser->add_flag("--resubmit", arguments->resubmit,
                   "submit the shards that lack results and are not in the queue");
  return {parser, [arguments] { return ShowStatus(*arguments); }};
}

}  // namespace warmjoint
