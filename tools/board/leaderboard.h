// Which identifier to trust: the results of a run, summed up.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "models/friction/joint_kind.h"
#include "scenarios/suite.h"
#include "tools/board/statistics.h"
#include "tools/store/run_store.h"

namespace warmjoint::inline tools {

/// One parameter of the truth over all realizations.
struct ParameterRow {
  std::string name;
  std::optional<double> coverage95;  // share of intervals that hold the truth; empty without any
  double efficiency = 0;             // rms error / rms Cramer-Rao bound; 1 is best, NaN unknown
};

/// One identifier over all realizations. Summaries run over the realizations that it answered.
struct LeaderboardRow {
  std::string identifier;  // label
  int runs = 0;
  std::map<std::string, int> failures;  // status: count; every status but ok
  std::string failure_example;          // message of the first failure
  Summary npe_continuous{}, npe_discrete{}, rmse{}, fit{}, fpe{}, mae{};
  Summary seconds{};
  std::vector<ParameterRow> parameters;    // continuous, in the order of the truth
  std::vector<std::string> not_estimated;  // continuous parameters that never were; count as 0
  std::optional<Claim> claim;
  std::optional<Difference> behind;  // empty for the best itself
  double rank_npe = 0;  // median continuous NPE with runs without an answer as infinite

  int failed() const;
};

struct Leaderboard {
  std::string suite;
  std::string question;
  int realizations = 0;  // of the suite
  int finished = 0;      // of them in the store
  JointKind joint = JointKind::rotary;
  double bound_npe_continuous = 0;   // rms NPE of an estimate at the Cramer-Rao bound, or NaN
  double bound_npe_discrete = 0;     // the same for the discrete pair
  std::vector<LeaderboardRow> rows;  // best first

  // groups of a suite with a ladder, in its order; those have the following two, too
  std::vector<Leaderboard> groups;
  std::string variant;
  std::optional<double> value;  // of the ladder's variable
  std::string variable;         // what the ladder climbs, with its unit
};

/// Sums up what the store holds over all variants of its suite, and for each of them. Memory: some 70
/// bytes for each result of one identifier at a time. Throws BadInput where the database is damaged.
Leaderboard ReadBoard(const RunStore& store);

}  // namespace warmjoint::inline tools
