// warmjoint status RUN: how far a planned run is; --resubmit starts what is missing.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "models/foundation/bad_input.h"
#include "tools/cli/command.h"
#include "tools/cli/typed_options.h"
#include "tools/cluster/resubmit.h"
#include "tools/cluster/run_layout.h"
#include "tools/cluster/run_status.h"
#include "tools/cluster/slurm.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kMostPieces = 1000;

struct StatusArguments {
  std::string run;
  std::string format = "text";
  bool resubmit = false;
  std::optional<std::uint64_t> split;
};

/// What Slurm says; nothing where nothing was submitted or nobody answers.
std::optional<QueuedShards> AskSlurm(const fs::path& run) {
  // without submissions there is nothing to ask
  const Submissions submissions = ReadSubmissions(run);
  if (submissions.arrays.empty()) return std::nullopt;
  const auto queue = AskQueue();
  if (!queue) return std::nullopt;
  return InQueue(submissions, *queue);
}

ExitStatus ShowStatus(const StatusArguments& arguments) {
  const fs::path run = fs::absolute(arguments.run).lexically_normal();
  // pieces are of what is started again
  if (arguments.split && !arguments.resubmit) {
    Refuse({"warmjoint status"}, "--split goes with --resubmit");
  }
  // first what is started again, so that the status counts it
  if (arguments.resubmit) {
    const std::vector<int> again = Resubmit(run, static_cast<int>(arguments.split.value_or(1)));
    fmt::print(stderr, "{}\n",
               again.empty() ? "nothing is missing" : "submitted again: shards " + Ranges(again));
  }
  const RunStatus status = StatusOf(run, ReadPlan(run), AskSlurm(run));
  fmt::print("{}", arguments.format == "json" ? StatusJson(status).dump(2) + "\n"
                                              : StatusText(run, status));
  return ExitStatus::done;
}

}  // namespace

Command AddStatusCommand(CLI::App& program) {
  auto arguments = std::make_shared<StatusArguments>();
  CLI::App* parser = program.add_subcommand("status", "How far a planned run is");
  // what is told, then what is started
  parser->add_option("RUN", arguments->run, "directory of `run --slurm` or --local-shards")
      ->type_name("RUN")
      ->required();
  AddChoice(*parser, "--format", arguments->format, {"text", "json"}, "of what is printed");
  parser->add_flag("--resubmit", arguments->resubmit,
                   "submit the shards that are missing or failed and not in the queue");
  AddWholeNumber(*parser, "--split", arguments->split, 1, kMostPieces,
                 "with --resubmit: what is open of each shard in so many pieces");
  return {parser, [arguments] { return ShowStatus(*arguments); }};
}

}  // namespace warmjoint::inline tools
