#include "tools/board/leaderboard.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tools/board/board_builder.h"
#include "tools/board/paired_difference.h"
#include "tools/board/sum_up.h"

namespace warmjoint::inline tools {
namespace {

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

/// Rows, best first, each with its distance from the best.
std::vector<LeaderboardRow> Rank(const Suite& suite,
                                 const std::vector<IdentifierColumns>& columns) {
  std::vector<LeaderboardRow> rows;
  std::vector<std::size_t> order(columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    rows.push_back(columns[i].SumUp(suite.identifiers[i]));
    order[i] = i;
  }
  // ranks by error, and suite order where two are equal
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return Better(rows[a], rows[b]); });

  // all others are compared with the best one, realization by realization
  std::vector<LeaderboardRow> ranked;
  for (const std::size_t i : order) {
    // columns are in the order of units
    if (!ranked.empty()) {
      rows[i].behind = PairedDifference(columns[i].RankedNpe(), columns[order[0]].RankedNpe());
    }
    ranked.push_back(std::move(rows[i]));
  }
  return ranked;
}

Leaderboard SumUpBoard(const Suite& suite, const GroupColumns& group) {
  // the suite, and how well it could be done
  Leaderboard board;
  board.suite = suite.name;
  board.question = suite.question;
  board.joint = suite.scenario.joint_kind;
  board.finished = group.units;
  board.bound_npe_continuous = group.bound_continuous.Root();
  board.bound_npe_discrete = group.bound_discrete.Root();
  board.rows = Rank(suite, group.identifiers);
  return board;
}

}  // namespace

GroupColumns::GroupColumns(const Suite& suite, const std::shared_ptr<NumberFile>& file) {
  for (std::size_t i = 0; i < suite.identifiers.size(); ++i) identifiers.emplace_back(file);
}

BoardBuilder::BoardBuilder(Suite suite) : suite_(std::move(suite)) {
  for (int i = 0; i < suite_.variants(); ++i) groups_.emplace_back(suite_, file_);
}

void BoardBuilder::Add(std::span<const Result> unit) {
  if (unit.empty()) return;
  GroupColumns& group = groups_.at(static_cast<std::size_t>(unit.front().variant));
  ++group.units;
  bool bounded = false;
  for (const Result& result : unit) {
    group.identifiers.at(static_cast<std::size_t>(result.identifier)).Add(result);
    // the bounds depend on truth and recording alone
    if (!result.score || std::exchange(bounded, true)) continue;
    group.bound_continuous.Add(result.score->bound_npe_continuous);
    group.bound_discrete.Add(result.score->bound_npe_discrete);
  }
}

GroupColumns BoardBuilder::All() const {
  GroupColumns all(suite_, file_);
  for (const GroupColumns& group : groups_) all.Add(group);
  return all;
}

Leaderboard BoardBuilder::Finish() const {
  // all groups as one, however they are parted
  Leaderboard board = SumUpBoard(suite_, groups_.size() == 1 ? groups_.front() : All());
  board.realizations = suite_.realizations * suite_.variants();
  if (!suite_.ladder) return board;

  // a board for each rung of the ladder
  board.variable = suite_.ladder->variable;
  if (!suite_.ladder->unit.empty()) board.variable += " " + suite_.ladder->unit;
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    Leaderboard group = SumUpBoard(suite_, groups_[i]);
    group.realizations = suite_.realizations;
    group.variant = suite_.ladder->variants[i].name;
    group.value = suite_.ladder->variants[i].value;
    board.groups.push_back(std::move(group));
  }
  return board;
}

void GroupColumns::Add(const GroupColumns& other) {
  units += other.units;
  bound_continuous.Add(other.bound_continuous);
  bound_discrete.Add(other.bound_discrete);
  for (std::size_t i = 0; i < identifiers.size(); ++i) identifiers[i].Add(other.identifiers[i]);
}

Leaderboard MakeLeaderboard(const Suite& suite, const std::vector<Result>& results) {
  BoardBuilder builder(suite);
  // results of one unit stand beside each other
  for (auto begin = results.begin(); begin != results.end();) {
    const auto end = std::find_if(begin, results.end(), [&](const Result& result) {
      return result.variant != begin->variant || result.realization != begin->realization;
    });
    builder.Add({begin, end});
    begin = end;
  }
  return builder.Finish();
}

}  // namespace warmjoint::inline tools
