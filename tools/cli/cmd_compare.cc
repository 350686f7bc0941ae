// warmjoint compare RUN: the leaderboard; compare estimate.json truth.json: an estimate beside its truth.
#include <fmt/format.h>
#include <warmjoint/estimate.h>

#include <filesystem>
#include <memory>

#include "models/foundation/bad_input.h"
#include "tools/board/format_board.h"
#include "tools/cli/command.h"
#include "tools/cli/estimate_table.h"
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

/// Of an estimate file and a truth file, or a friction file.
std::string CompareWithTruth(const std::string& file, const std::string& truth,
                             const std::string& format) {
  const Estimate estimate = ReadEstimate(file);
  if (estimate.friction && !estimate.friction->torque_unit.empty()) {
    Refuse({file}, "is in {} and a truth is not; identify with --torque-constant",
           estimate.friction->torque_unit);
  }
  return FormatCompared(estimate, ReadFriction(truth), format);
}

/// Text for people, broken at the width of their terminal; all else as it is, for programs.
void Print(const std::string& text, const std::string& format) {
  if (format == "text") return SayText(stdout, text);
  fmt::print("{}", text);
}

ExitStatus Compare(const CompareArguments& arguments) {
  const std::vector<std::string>& files = arguments.runs;
  if (std::filesystem::is_regular_file(files[0])) {
    if (files.size() != 2)
      Refuse({files[0]}, "is no run; give an estimate and its truth, two files");
    Print(CompareWithTruth(files[0], files[1], arguments.format), arguments.format);
    return ExitStatus::done;
  }
  const std::vector<NamedBoard> boards = ReadBoards(arguments.runs);
  // the format that was asked for; several runs stand in one table
  for (const BoardFormat& format : BoardFormats()) {
    if (format.name != arguments.format) continue;
    const Page page = PageOf(stdout);
    const std::string text =
        boards.size() == 1 ? format.write(boards[0].board, page) : format.join(boards, page);
    Print(text, format.name);
  }
  return ExitStatus::done;
}

}  // namespace

Command AddCompareCommand(CLI::App& program) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App* parser =
      program.add_subcommand("compare", "Leaderboard of a run, or an estimate beside its truth");
  GiveExample(*parser, "warmjoint compare runs/table1");
  AddValue(*parser, "RUN", "RUN", arguments->runs,
           "run directories, or estimate.json and truth.json")
      ->required();

  std::vector<std::string> names;
  for (const BoardFormat& format : BoardFormats()) names.push_back(format.name);
  AddChoice(*parser, "--format", arguments->format, names, "of the leaderboard");
  return {parser, [arguments] { return Compare(*arguments); }};
}

}  // namespace warmjoint
