// warmjoint compare RUN: the leaderboard.
#include <fmt/format.h>

#include <memory>

#include "tools/command.h"
#include "tools/leaderboard/format_board.h"
#include "tools/leaderboard/leaderboard.h"
#include "tools/store/run_store.h"

namespace warmjoint {
namespace {

struct CompareArguments {
  std::string run;
  std::string format = "text";
};

ExitStatus Compare(const CompareArguments& arguments) {
  const RunStore store = RunStore::OpenToRead(arguments.run);
  const Leaderboard board = MakeLeaderboard(ReadSuite(store.suite_file()), store.ReadResults());
  for (const BoardFormat& format : BoardFormats()) {
    if (format.name == arguments.format) fmt::print("{}", format.write(board));
  }
  return ExitStatus::done;
}

}  // namespace

Command AddCompareCommand(CLI::App& program) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App* parser =
      program.add_subcommand("compare", "Leaderboard of a run: which identifier to trust");
  parser->add_option("RUN", arguments->run, "run directory")->required();

  std::vector<std::string> names;
  for (const BoardFormat& format : BoardFormats()) names.push_back(format.name);
  parser->add_option("--format", arguments->format, "text, markdown, json or csv")
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  return {parser, [arguments] { return Compare(*arguments); }};
}

}  // namespace warmjoint
