// All realizations of a suite on all cores.
#pragma once

#include "scenarios/suite.h"
#include "tools/run/prepared_identifier.h"
#include "tools/store/run_store.h"

namespace warmjoint {

/// How a run ended.
struct RunOutcome {
  int finished = 0;  // realizations of all variants that are in the store now
  bool interrupted = false;
};

/// Runs the realizations that the store lacks, in batches of whole realizations, on `jobs` threads
/// with plants of their own. Results depend on (suite seed, realization) alone. Ctrl-C ends it
/// after the realizations in hand, which are kept.
RunOutcome RunSuite(const Suite& suite, const std::vector<PreparedIdentifier>& identifiers,
                    int jobs, RunStore& store);

}  // namespace warmjoint
