// warmjoint compare RUN: the leaderboard.
#include <fmt/format.h>

#include <memory>

#include "tools/board/format_board.h"
#include "tools/cli/command.h"
#include "tools/cli/typed_options.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

struct CompareArguments {
  std::vector<std::string> runs;
  std::string format = "text";
};

std::vector<NamedBoard> ReadBoards(const std::vector<std::string>& runs) {
  std::vector<NamedBoard> boards;
  // an edited copy of a suite is told of, and the stored one counts
  for (const std::string& run : runs) {
    const RunStore store = RunStore::OpenToRead(run);
    NoticeEditedSuite(store);
    boards.push_back({run, ReadBoard(store)});
  }
  return boards;
}

ExitStatus Compare(const CompareArguments& arguments) {
  const std::vector<NamedBoard> boards = ReadBoards(arguments.runs);
  // the format that was asked for; several runs stand in one table
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
  parser->add_option("RUN", arguments->runs, "run directories")->type_name("RUN")->required();

  std::vector<std::string> names;
  for (const BoardFormat& format : BoardFormats()) names.push_back(format.name);
  AddChoice(*parser, "--format", arguments->format, names, "of the leaderboard");
  return {parser, [arguments] { return Compare(*arguments); }};
}

}  // namespace warmjoint
