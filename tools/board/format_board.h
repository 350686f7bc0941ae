// The leaderboard in the formats of `compare`.
#pragma once

#include <string>
#include <vector>

#include "tools/board/leaderboard.h"
#include "tools/terminal/say.h"

namespace warmjoint {

/// A leaderboard and the run directory that it comes from.
struct NamedBoard {
  std::string run;
  Leaderboard board;
};

/// A format of `compare --format`, for one run and for several side by side. page: the terminal or file that it goes to
struct BoardFormat {
  std::string name;
  std::string (*write)(const Leaderboard& board, const Page& page);
  std::string (*join)(const std::vector<NamedBoard>& boards, const Page& page);
};

/// All formats: a new one is a function or two and one line in format_board.cc.
const std::vector<BoardFormat>& BoardFormats();

/// For the terminal: the answer first, then the tables.
std::string BoardToText(const Leaderboard& board, const Page& page = {});

/// The same for documents.
std::string BoardToMarkdown(const Leaderboard& board, const Page& page = {});

/// The contract's JSON; numbers that do not exist are null.
std::string BoardToJson(const Leaderboard& board, const Page& page = {});

/// All runs in one table, then each of them.
std::string BoardsToText(const std::vector<NamedBoard>& boards, const Page& page = {});
std::string BoardsToMarkdown(const std::vector<NamedBoard>& boards, const Page& page = {});

/// {"runs": [{"run": directory, and what BoardToJson has}]}.
std::string BoardsToJson(const std::vector<NamedBoard>& boards, const Page& page = {});

/// As BoardToCsv, with the run in the first column.
std::string BoardsToCsv(const std::vector<NamedBoard>& boards, const Page& page = {});

/// One row for each identifier in each variant, "all" where there is no ladder. All numbers in full.
std::string BoardToCsv(const Leaderboard& board, const Page& page = {});

/// Writes the tables of a run that people read: RUN/results.csv, a row for each result (ExportResults),
/// and RUN/summary.csv, the leaderboard as BoardToCsv. Wall times stay out of both, so that equal results are equal bytes.
void WriteTables(const RunStore& store);

}  // namespace warmjoint
