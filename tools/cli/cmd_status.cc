// warmjoint status RUN: which shards of a planned run lack results; --resubmit starts these again.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "tools/cli/command.h"
#include "tools/cli/typed_options.h"
#include "tools/cluster/run_status.h"
#include "tools/store/folders.h"

namespace warmjoint {
namespace {

struct StatusArguments {
  std::string run;
  std::string format = "text";
  bool resubmit = false;
};

/// Starts again what is lost, and says what it was. Nobody else may plan or submit meanwhile.
void Resubmit(const Plan& plan) {
  const DirectoryLock lock(plan.folder());
  const std::vector<int> again = SubmitOpen(plan);
  fmt::print(stderr, "{}\n",
             again.empty() ? "nothing is missing" : "submitted again: shards " + Ranges(again));
}

ExitStatus ShowStatus(const StatusArguments& arguments) {
  const Plan plan = ReadPlan(arguments.run);
  if (arguments.resubmit) Resubmit(plan);
  const RunStatus status = StatusOf(plan, AskQueue(plan));
  fmt::print("{}", arguments.format == "json" ? StatusJson(status).dump(2) + "\n"
                                              : StatusText(plan, status));
  return ExitStatus::done;
}

}  // namespace

Command AddStatusCommand(CLI::App& program) {
  auto arguments = std::make_shared<StatusArguments>();
  CLI::App* parser = program.add_subcommand("status", "Which shards of a planned run have results");
  parser->add_option("RUN", arguments->run, "directory of `run --slurm` or --local-shards")
      ->type_name("RUN")
      ->required();
  AddChoice(*parser, "--format", arguments->format, {"text", "json"}, "of what is printed");
  parser->add_flag("--resubmit", arguments->resubmit,
                   "submit the shards that lack results and are not in the queue");
  return {parser, [arguments] { return ShowStatus(*arguments); }};
}

}  // namespace warmjoint
