// One identifier's results, summed up.
#pragma once

#include <vector>

#include "tools/board/leaderboard.h"

namespace warmjoint::inline tools {

/// Results in the order of their units.
using Results = std::vector<const Result*>;

/// The row of one identifier from its own results.
LeaderboardRow SumUp(const SuiteIdentifier& identifier, const Results& results);

/// Continuous NPE of each result; a run without an answer counts as infinitely wrong, so that
/// nobody wins by answering the easy ones alone.
std::vector<double> RankedNpe(const Results& results);

/// Summary of one number of each result's score; those without a score are left out.
Summary SummariseScore(const Results& results, double Score::*number);

}  // namespace warmjoint::inline tools
