// What a run keeps of each realization.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/score.h>

#include <compare>
#include <optional>
#include <string>
#include <vector>

namespace warmjoint {

/// The course of an iterative identifier, for pictures: single precision, one row an iteration.
struct TraceTable {
  std::vector<std::string> columns;  // iteration, rmse, npe_continuous, npe_discrete, parameters
  std::vector<float> values;         // [rows x columns], row after row; NaN where unknown

  size_t rows() const { return columns.empty() ? 0 : values.size() / columns.size(); }
};

/// What one identifier made of one realization.
struct Result {
  int variant = 0;  // position in the suite's ladder; 0 without one
  int realization = 0;
  int identifier = 0;   // position in the suite's list
  std::string status;   // a StatusName, or how the identifier failed to answer
  std::string message;  // one sentence
  std::optional<Metrics> metrics;
  std::optional<Score> score;  // where there are numbers to score
  TraceTable trace;            // empty where the identifier does not iterate
  double seconds = 0;          // wall time of the identification
};

/// One realization of one variant of a suite: the unit of work.
struct RunUnit {
  int variant = 0;      // position in the suite's ladder; 0 without one
  int realization = 0;  // from 0

  auto operator<=>(const RunUnit&) const = default;
};

/// A finished unit: it enters the store as a whole or not at all.
struct Realization {
  RunUnit unit;
  double simulation_seconds = 0;  // wall time of the plant
  std::vector<Result> results;    // one for each identifier of the suite, in its order
};

}  // namespace warmjoint
