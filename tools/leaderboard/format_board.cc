#include "tools/leaderboard/format_board.h"

#include <fmt/format.h>

#include "tools/leaderboard/board_tables.h"

namespace warmjoint {
namespace {

std::string Head(const Leaderboard& board) {
  return fmt::format("{} realizations. NPE: relative error over all parameters of the truth (26).",
                     board.finished);
}

}  // namespace

const std::vector<BoardFormat>& BoardFormats() {
  static const std::vector<BoardFormat> formats{
      {"text", BoardToText},
      {"markdown", BoardToMarkdown},
      {"json", BoardToJson},
      {"csv", BoardToCsv},
  };
  return formats;
}

std::string BoardToText(const Leaderboard& board) {
  std::string text =
      fmt::format("{}: {}\n{}\n{}\n\n", board.suite, board.question, Verdict(board), Head(board));
  text += TableToText(RankingTable(board), 2) + "\n";
  text += TableToText(AgreementTable(board), 1) + "\n";
  const Table parameters = ParameterTable(board);
  if (!parameters.rows.empty()) text += TableToText(parameters, 2) + "\n";
  for (const std::string& note : Notes(board)) text += fmt::format("* {}\n", note);
  return text;
}

std::string BoardToMarkdown(const Leaderboard& board) {
  std::string text = fmt::format("### {}\n\n{}\n\n**{}** {}\n\n", board.suite, board.question,
                                 Verdict(board), Head(board));
  text += TableToMarkdown(RankingTable(board), 2) + "\n";
  text += TableToMarkdown(AgreementTable(board), 1) + "\n";
  const Table parameters = ParameterTable(board);
  if (!parameters.rows.empty()) text += TableToMarkdown(parameters, 2) + "\n";
  for (const std::string& note : Notes(board)) text += fmt::format("- {}\n", note);
  return text;
}

}  // namespace warmjoint
