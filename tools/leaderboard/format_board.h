// The leaderboard in the formats of `compare`.
#pragma once

#include <string>
#include <vector>

#include "tools/leaderboard/leaderboard.h"

namespace warmjoint {

/// A format of `compare --format`.
struct BoardFormat {
  std::string name;
  std::string (*write)(const Leaderboard& board);
};

/// All formats: a new one is its own file and one line in format_board.cc.
const std::vector<BoardFormat>& BoardFormats();

/// For the terminal: the answer first, then the tables.
std::string BoardToText(const Leaderboard& board);

/// The same for documents.
std::string BoardToMarkdown(const Leaderboard& board);

/// The contract's JSON; numbers that do not exist are null.
std::string BoardToJson(const Leaderboard& board);

/// One row for each identifier, all numbers in full.
std::string BoardToCsv(const Leaderboard& board);

}  // namespace warmjoint
