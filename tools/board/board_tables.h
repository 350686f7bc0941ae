// The leaderboard's tables and sentences, shared by text and Markdown.
#pragma once

#include <string>
#include <vector>

#include "tools/board/leaderboard.h"
#include "tools/terminal/table.h"

namespace warmjoint {

/// Who wins: a row for each identifier, best first, and one for the Cramer-Rao bound.
Table RankingTable(const Leaderboard& board);

/// Median NPE of each group of a ladder, one column an identifier; no rows without a ladder.
Table GroupTable(const Leaderboard& board);

/// Agreement with the data and time: RMSE, Fit, FPE, MAE, seconds.
Table AgreementTable(const Leaderboard& board);

/// Coverage and efficiency for each parameter; no rows where nothing was estimated.
Table ParameterTable(const Leaderboard& board);

/// The answer in one sentence.
std::string Verdict(const Leaderboard& board);

/// One sentence each: claims beside what was reached, failures, parameters that count as 0.
std::vector<std::string> Notes(const Leaderboard& board);

/// "1.10 %" of 0.011; "-" of NaN.
std::string PercentText(double share);

/// Three digits; "-" of NaN.
std::string NumberText(double value);

}  // namespace warmjoint
