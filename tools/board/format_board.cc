#include "tools/board/format_board.h"

#include <fmt/format.h>

#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"
#include "tools/board/board_tables.h"

namespace warmjoint {
namespace {

std::string Head(const Leaderboard& board) {
  return fmt::format("{} realizations. NPE: relative error over all parameters of the truth (26).",
                     board.finished);
}

/// Every identifier of every run.
Table SideBySide(const std::vector<NamedBoard>& boards) {
  Table table{{"run", "identifier", "failed", "NPE median", "NPE rms", "bound"}, {}};
  for (const NamedBoard& named : boards) {
    std::string run = named.run;
    // the run is named once for all of its identifiers
    for (const LeaderboardRow& row : named.board.rows) {
      table.rows.push_back({run, row.identifier, std::to_string(row.failed()),
                            PercentText(row.npe_continuous.median),
                            PercentText(row.npe_continuous.rms),
                            PercentText(named.board.bound_npe_continuous)});
      run.clear();
    }
  }
  return table;
}

/// Markdown in which nothing is HTML, and on which no terminal acts.
std::string Harmless(const std::string& markdown) {
  std::string text;
  for (const char c : PrintableLines(markdown)) {
    text += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return text;
}

}  // namespace

const std::vector<BoardFormat>& BoardFormats() {
  static const std::vector<BoardFormat> formats{
      {"text", BoardToText, BoardsToText},
      {"markdown", BoardToMarkdown, BoardsToMarkdown},
      {"json", BoardToJson, BoardsToJson},
      {"csv", BoardToCsv, BoardsToCsv},
  };
  return formats;
}

std::string BoardToText(const Leaderboard& board) {
  // the verdict first, then who is how good
  std::string text =
      fmt::format("{}: {}\n{}\n{}\n\n", board.suite, board.question, Verdict(board), Head(board));
  text += TableToText(RankingTable(board), 2) + "\n";
  // variants beside each other, where there are some
  const Table groups = GroupTable(board);
  if (!groups.rows.empty()) {
    text += fmt::format("Rms NPE by group, beside the bound:\n{}\n", TableToText(groups, 1));
  }

  // how well torques agree, how well each parameter is known, and what remains to be said
  text += TableToText(AgreementTable(board), board.groups.size() < 2 ? 1 : 2) + "\n";
  const Table parameters = ParameterTable(board);
  if (!parameters.rows.empty()) text += TableToText(parameters, 2) + "\n";
  for (const std::string& note : Notes(board)) text += fmt::format("* {}\n", note);
  return PrintableLines(text);
}

std::string BoardToMarkdown(const Leaderboard& board) {
  // the verdict first, then who is how good
  std::string text = fmt::format("### {}\n\n{}\n\n**{}** {}\n\n", board.suite, board.question,
                                 Verdict(board), Head(board));
  text += TableToMarkdown(RankingTable(board), 2) + "\n";
  // variants beside each other, where there are some
  const Table groups = GroupTable(board);
  if (!groups.rows.empty()) {
    text += fmt::format("Rms NPE by group, beside the bound:\n\n{}\n", TableToMarkdown(groups, 1));
  }

  // how well torques agree, how well each parameter is known, and what remains to be said
  text += TableToMarkdown(AgreementTable(board), board.groups.size() < 2 ? 1 : 2) + "\n";
  const Table parameters = ParameterTable(board);
  if (!parameters.rows.empty()) text += TableToMarkdown(parameters, 2) + "\n";
  for (const std::string& note : Notes(board)) text += fmt::format("- {}\n", note);
  return Harmless(text);
}

std::string BoardsToText(const std::vector<NamedBoard>& boards) {
  std::string text = PrintableLines(TableToText(SideBySide(boards), 2));
  for (const NamedBoard& named : boards) text += fmt::format("\n{}", BoardToText(named.board));
  return text;
}

std::string BoardsToMarkdown(const std::vector<NamedBoard>& boards) {
  std::string text = Harmless(TableToMarkdown(SideBySide(boards), 2));
  for (const NamedBoard& named : boards) text += fmt::format("\n{}", BoardToMarkdown(named.board));
  return text;
}

Leaderboard ReadLeaderboard(const std::filesystem::path& directory) {
  return ReadBoard(RunStore::OpenToRead(directory));
}

std::string FormatLeaderboard(const std::filesystem::path& directory, const std::string& format) {
  // the formats are those of `compare`
  std::vector<std::string> known;
  for (const BoardFormat& one : BoardFormats()) {
    known.push_back(one.name);
    if (one.name == format) return one.write(ReadLeaderboard(directory));
  }
  Refuse({"--format"}, "is '{}'{}", Excerpt(format), Suggestion(format, known));
}

}  // namespace warmjoint
