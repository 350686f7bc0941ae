#include "tools/board/leaderboard.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "tools/board/paired_difference.h"
#include "tools/board/sum_up.h"

namespace warmjoint::inline tools {
namespace {

/// One result for each unit: the first that carries a score, for what depends on the truth and the
/// recording alone.
Results OneOfEachUnit(const Results& results) {
  Results ones;
  std::set<Unit> seen;
  for (const Result* result : results) {
    const Unit unit{result->variant, result->realization};
    if (result->score && seen.insert(unit).second) ones.push_back(result);
  }
  return ones;
}

/// Best first; NaN, which an identifier without any run has, last.
bool Better(const LeaderboardRow& a, const LeaderboardRow& b) {
  const auto key = [](const LeaderboardRow& row) {
    const double rank =
        std::isnan(row.rank_npe) ? std::numeric_limits<double>::infinity() : row.rank_npe;
    const double rms = std::isnan(row.npe_continuous.rms) ? std::numeric_limits<double>::infinity()
                                                          : row.npe_continuous.rms;
    return std::pair(rank, rms);
  };
  return key(a) < key(b);
}

Results ResultsOf(const Results& results, int identifier) {
  Results own;
  for (const Result* result : results) {
    if (result->identifier == identifier) own.push_back(result);
  }
  return own;
}

/// Rows, best first, each with its distance from the best.
std::vector<LeaderboardRow> Rank(const Suite& suite, const Results& results) {
  struct Entry {
    LeaderboardRow row;
    std::vector<double> npe;  // in the order of units
  };
  std::vector<Entry> entries;
  for (size_t i = 0; i < suite.identifiers.size(); ++i) {
    const Results own = ResultsOf(results, static_cast<int>(i));
    entries.push_back({SumUp(suite.identifiers[i], own), RankedNpe(own)});
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return Better(a.row, b.row); });

  std::vector<LeaderboardRow> rows;
  for (Entry& entry : entries) {
    if (!rows.empty()) entry.row.behind = PairedDifference(entry.npe, entries.front().npe);
    rows.push_back(std::move(entry.row));
  }
  return rows;
}

Leaderboard SumUpBoard(const Suite& suite, const Results& results) {
  Leaderboard board;
  board.suite = suite.name;
  board.question = suite.question;
  board.joint = suite.scenario.joint_kind;

  std::set<Unit> finished;
  for (const Result* result : results) finished.insert({result->variant, result->realization});
  board.finished = static_cast<int>(finished.size());
  const Results ones = OneOfEachUnit(results);
  board.bound_npe_continuous = SummariseScore(ones, &Score::bound_npe_continuous).rms;
  board.bound_npe_discrete = SummariseScore(ones, &Score::bound_npe_discrete).rms;
  board.rows = Rank(suite, results);
  return board;
}

}  // namespace

Leaderboard MakeLeaderboard(const Suite& suite, const std::vector<Result>& results) {
  Results all;
  for (const Result& result : results) all.push_back(&result);
  Leaderboard board = SumUpBoard(suite, all);
  board.realizations = suite.realizations * suite.variants();
  if (!suite.ladder) return board;

  board.variable = suite.ladder->variable;
  if (!suite.ladder->unit.empty()) board.variable += " " + suite.ladder->unit;
  for (int i = 0; i < suite.variants(); ++i) {
    Results own;
    for (const Result* result : all) {
      if (result->variant == i) own.push_back(result);
    }
    Leaderboard group = SumUpBoard(suite, own);
    group.realizations = suite.realizations;
    group.variant = suite.ladder->variants[static_cast<size_t>(i)].name;
    group.value = suite.ladder->variants[static_cast<size_t>(i)].value;
    board.groups.push_back(std::move(group));
  }
  return board;
}

}  // namespace warmjoint::inline tools
