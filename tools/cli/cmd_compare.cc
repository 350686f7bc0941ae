// warmjoint compare RUN: the leaderboard.
#include <fmt/format.h>

#include <memory>

#include "tools/actions/read_board.h"
#include "tools/board/format_board.h"
#include "tools/cli/command.h"
#include "tools/store/stored_suite.h"

namespace warmjoint::inline tools {
namespace {

struct CompareArguments {
  std::vector<std::string> runs;
  std::string format = "text";
};

std::vector<NamedBoard> ReadBoards(const std::vector<std::string>& runs) {
  std::vector<NamedBoard> boards;
  for (const std::string& run : runs) {
    const RunStore store = RunStore::OpenToRead(run);
    TellOfEditedSuite(store);
    boards.push_back({run, ReadBoard(store)});
  }
  return boards;
}

ExitStatus Compare(const CompareArguments& arguments) {
  const std::vector<NamedBoard> boards = ReadBoards(arguments.runs);
  for (const BoardFormat& format : BoardFormats()) {
    if (format.name != arguments.format) continue;
    fmt::print("{}", boards.size() == 1 ? format.write(boards[0].board) : format.join(boards));
  }
  return ExitStatus::done;
}

}  // namespace

Command AddCompareCommand(CLI::App& program) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App* parser =
      program.add_subcommand("compare", "Leaderboard of a run: which identifier to trust");
  parser->add_option("RUN", arguments->runs, "run directories")->required();

  std::vector<std::string> names;
  for (const BoardFormat& format : BoardFormats()) names.push_back(format.name);
  parser->add_option("--format", arguments->format, "text, markdown, json or csv")
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  return {parser, [arguments] { return Compare(*arguments); }};
}

}  // namespace warmjoint::inline tools
