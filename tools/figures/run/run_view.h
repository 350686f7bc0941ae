// A run of a suite as its pictures need it: plain numbers, one row an identifier.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tools/board/leaderboard.h"
#include "tools/store/run_store.h"

namespace warmjoint::figures {

/// One parameter of the truth and what one identifier made of it. All: [R], by realization that is drawn;
/// NaN where there is no answer.
struct ParameterColumn {
  std::string name;
  std::string unit;
  Eigen::VectorXd estimate;  // NaN where not estimated
  Eigen::VectorXd truth;
  Eigen::VectorXd bound;  // Cramer-Rao standard deviation
  int intervals = 0;      // 95 % intervals that were given
  int covered = 0;        // of them, those that hold the truth
};

/// The trace of an identifier that iterates: K iterations of R realizations, of the first 2000 in a longer run. One that stopped
/// early keeps its last values.
struct ParameterTrace {
  Eigen::VectorXd iteration;                // [K]
  Eigen::MatrixXd npe;                      // [R x K] continuous, 0.05 is 5 %
  Eigen::MatrixXd rmse;                     // [R x K] N.m or N
  std::vector<std::string> names;           // of parameters
  std::vector<Eigen::MatrixXd> parameters;  // for each name: [R x K]
};

/// What the variants of a suite are, in the order of its ladder; empty without one.
struct Rungs {
  std::string variable;  // what the values are of, with `unit`
  std::string unit;
  Eigen::VectorXd values;          // 0, 1, 2, ... where the variants have names alone
  std::vector<std::string> names;  // empty where they have values
};

struct RunRow {
  std::string label;                         // row of the leaderboard
  std::string identifier;                    // name in the list of identifiers: gives the colour
  int runs = 0;                              // all, drawn or not
  std::map<std::string, int> failures;       // status: count, of all
  Eigen::VectorXi variant, realization;      // [R] position in the ladder, and number
  Eigen::VectorXd npe, rmse, fit, fpe, mae;  // [R], NaN without an answer
  std::vector<ParameterColumn> parameters;   // continuous, in the order of the truth
  ParameterTrace trace;                      // K = 0 where it does not iterate

  int failed() const;
};

/// What one identifier made of one realization.
struct ListedAnswer {
  RunUnit unit;
  int identifier = 0;  // position in the suite's list
  std::string status;
  double npe = 0, rmse = 0, fit = 0;  // 0.01 is 1 %; N.m or N; %; NaN without an answer
};

/// All answers of a short run. Of a longer one, realizations 0, n, 2 n, ... of each variant, and the first
/// failures besides.
struct Listing {
  int every = 1;
  std::vector<ListedAnswer> answers;  // in the order of units
};

struct RunView {
  Leaderboard board;
  std::string suite;
  std::string question;
  int realizations = 0;  // finished
  int drawn_every = 1;   // of these, realizations 0, n, 2 n, ... of each variant are drawn
  Rungs rungs;
  std::string torque_unit;
  double bound_npe = 0;      // rms continuous NPE at the Cramer-Rao bound, NaN where unknown
  double noise = 0;          // standard deviation on the stored torque, N.m or N; NaN unknown
  std::vector<RunRow> rows;  // in the order of the suite
  /// Cramer-Rao covariance of the relative errors in per cent, [d x d], in the order of the truth's
  /// parameters; empty where unknown.
  Eigen::MatrixXd bound_covariance;
  Listing listing;
};

/// Realizations of a run that pictures are drawn of; of a longer run, every second, third, ...
inline constexpr std::int64_t kMostDrawn = 20000;

/// Reads a run, unit by unit, with memory that does not grow with it. Throws BadInput where nothing is
/// finished yet.
RunView ReadRunView(const RunStore& store, std::int64_t most_drawn = kMostDrawn);

}  // namespace warmjoint::figures
