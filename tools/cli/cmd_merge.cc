// warmjoint merge SHARD... -o RUN: shards of a run put together.
#include <fmt/format.h>

#include <memory>

#include "tools/cli/command.h"
#include "tools/store/export_csv.h"
#include "tools/store/merge_runs.h"

namespace warmjoint::inline tools {
namespace {

struct MergeArguments {
  std::vector<std::filesystem::path> shards;
  std::string output;
};

ExitStatus Merge(const MergeArguments& arguments) {
  const RunStore store = MergeRuns(arguments.shards, arguments.output);
  fmt::print("{}: {} results of {} shards; see: warmjoint compare {}\n", arguments.output,
             ExportResults(store).size(), arguments.shards.size(), arguments.output);
  return ExitStatus::done;
}

}  // namespace

Command AddMergeCommand(CLI::App& program) {
  auto arguments = std::make_shared<MergeArguments>();
  CLI::App* parser = program.add_subcommand("merge", "Put the shards of a run together");
  parser->add_option("SHARD", arguments->shards, "run directories made with --shard")->required();
  parser->add_option("-o,--output", arguments->output, "run directory to make")->required();
  return {parser, [arguments] { return Merge(*arguments); }};
}

}  // namespace warmjoint::inline tools
