// All realizations of a suite on all cores.
#pragma once

#include <functional>

#include "scenarios/suite.h"
#include "tools/store/run_store.h"
#include "tools/suite/following_tally.h"
#include "tools/suite/prepared_identifier.h"
#include "tools/suite/shard.h"

namespace warmjoint {

/// How much of a suite is run, and how.
struct RunOptions {
  int jobs = 1;  // threads
  Shard shard;
  bool keep_recordings = false;  // into DIR/recordings
  /// Is told how many realizations of how many are in the store; without it, stderr is. What it
  /// throws ends the run, and what is stored stays.
  std::function<void(int finished, int total)> watch{};
};

/// How a run ended.
struct RunOutcome {
  int finished = 0;  // realizations of all variants of the shard that are in the store
  int total = 0;     // of the shard
  bool interrupted = false;
  FollowingTally following{};  // of the realizations of this call
};

/// Runs the realizations that the store lacks, in batches of whole realizations, on threads
/// with plants of their own. Results depend on (suite seed, realization) alone. Ctrl-C ends it
/// after the realizations in hand, which are kept.
RunOutcome RunSuite(const Suite& suite, const std::vector<PreparedIdentifier>& identifiers,
                    const RunOptions& options, RunStore& store);

}  // namespace warmjoint
