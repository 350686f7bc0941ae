// What became of the results of a run.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "tools/store/run_store.h"

namespace warmjoint::inline tools {

/// What is said of a run at its end.
struct RunEnding {
  std::size_t results = 0;
  std::size_t refused = 0;        // by the identifier's own verdict: an answer as any other
  std::size_t unanswered = 0;     // crashed, took too long, or wrote something else
  std::size_t not_simulated = 0;  // there was nothing to identify
  /// Identifiers that answered in no realization, be it with a verdict: label, and the first reason.
  std::vector<std::pair<std::string, std::string>> silent;

  std::size_t failed() const { return refused + unanswered + not_simulated; }
};

/// Sums up a store.
RunEnding EndingOf(const RunStore& store);

/// "200 results, 99 refused by their own verdict, 1 without an answer".
std::string CountsInWords(const RunEnding& ending);

}  // namespace warmjoint::inline tools
