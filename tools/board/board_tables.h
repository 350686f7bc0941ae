// The leaderboard's tables and sentences, shared by text and Markdown.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tools/board/leaderboard.h"
#include "tools/terminal/say.h"

namespace warmjoint {

/// The variants of a ladder by name, or "all" in one where there is none. What is measured under different noise is
/// not put together.
std::vector<std::pair<std::string, const Standing*>> PartsOf(const Leaderboard& board);

/// Who wins: a row for each identifier, best first, and one for the Cramer-Rao bound. Of a ladder: in how many of its
/// variants each is as good as any.
Table RankingTable(const Leaderboard& board);

/// Rms NPE in each variant of a ladder beside its bound, with who is best there; no rows without a ladder.
Table GroupTable(const Leaderboard& board);

/// Agreement with the data and time: RMSE, Fit, FPE, MAE, seconds.
Table AgreementTable(const Leaderboard& board);

/// Whether compensators are compared.
bool Compensates(const Leaderboard& board);

/// What each compensator reaches, medians over the runs, and time.
Table MeasureTable(const Leaderboard& board);

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
