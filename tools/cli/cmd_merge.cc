// warmjoint merge SHARD... -o RUN: shards of a run put together.
#include <fmt/format.h>

#include <memory>

#include "models/foundation/bad_input.h"
#include "tools/cli/command.h"
#include "tools/cli/end_of_run.h"
#include "tools/cli/typed_options.h"
#include "tools/cluster/shards.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

struct MergeArguments {
  std::vector<std::filesystem::path> shards;
  std::string output;
};

/// Says which realizations no shard holds.
void NoticeMissing(const std::set<RunUnit>& missing) {
  // a few of them show where the hole is
  constexpr std::size_t most = 10;
  std::vector<std::string> shown;
  for (const RunUnit& unit : missing) {
    if (shown.size() == most) break;
    shown.push_back(unit.variant == 0
                        ? std::to_string(unit.realization)
                        : fmt::format("{} of variant {}", unit.realization, unit.variant));
  }
  SayNotice(
      "notice: no shard holds {} realizations ({}{}); merge with the shards that do, or go "
      "on with `run`\n",
      missing.size(), fmt::join(shown, ", "), missing.size() > most ? ", ..." : "");
}

/// A run that was planned as shards becomes whole in its own directory.
ExitStatus MergeInPlace(const std::filesystem::path& given) {
  MergePlanned(ReadPlan(given));
  return PrintEnding(given, EndingOf(RunStore::OpenToRead(given)), RunPart::whole);
}

ExitStatus Merge(const MergeArguments& arguments) {
  // without -o only a planned run can be merged, into itself
  if (arguments.output.empty()) {
    if (arguments.shards.size() == 1) return MergeInPlace(arguments.shards.front());
    Refuse({"warmjoint merge"}, "several shards need -o, the run directory to make");
  }

  // shards that overlap are refused here: each realization has one place
  const MergedRun merged = MergeRuns(arguments.shards, arguments.output);
  Say(stdout, "{}: {} shards, {} of {} realizations\n", arguments.output, arguments.shards.size(),
      merged.units - merged.missing.size(), merged.units);
  // what is missing is no failure, but then the whole says nothing yet
  if (!merged.missing.empty()) NoticeMissing(merged.missing);
  return PrintEnding(arguments.output, EndingOf(RunStore::OpenToRead(arguments.output)),
                     merged.missing.empty() ? RunPart::whole : RunPart::shard);
}

}  // namespace

Command AddMergeCommand(CLI::App& program) {
  auto arguments = std::make_shared<MergeArguments>();
  CLI::App* parser = program.add_subcommand("merge", "Put the shards of a run together");
  GiveExample(*parser, "warmjoint merge shard1 shard2 -o runs/whole");
  AddValue(*parser, "SHARD", "RUN", arguments->shards,
           "run directories made with --shard, or one that was planned")
      ->required();
  AddValue(*parser, "-o,--output", "DIR", arguments->output,
           "run directory to make; a planned run becomes whole in its own");
  return {parser, [arguments] { return Merge(*arguments); }};
}

}  // namespace warmjoint
