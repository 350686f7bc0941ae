// All realizations of a suite on all cores.
#pragma once

#include <warmjoint/simulation.h>

#include <cstdint>
#include <functional>
#include <string>

#include "scenarios/suite.h"
#include "tools/store/run_store.h"
#include "tools/suite/prepare_identifiers.h"

namespace warmjoint {

/// Counts the realizations whose joint did not follow.
class FollowingTally {
 public:
  void Add(RunUnit unit, const Following& following);

  /// What is to be said of them, with the worst; empty where every joint followed.
  std::string Words(const Suite& suite) const;

 private:
  int realizations_ = 0;
  int astray_ = 0;
  RunUnit worst_unit_;
  Following worst_;
};

inline constexpr int kMostShards = 1'000'000;

/// Part `index` (from 1) of `count`: a block of realizations, in all variants; the blocks follow one
/// another, and their sizes differ by 1 at most. The default is the whole.
struct Shard {
  int index = 1;
  int count = 1;

  /// Its first realization, and one beyond its last.
  int First(int realizations) const { return Shard{index - 1, count}.End(realizations); }
  int End(int realizations) const {
    return static_cast<int>(std::int64_t{index} * realizations / count);
  }

  bool IsWhole() const { return count == 1; }
};

/// Reads "i/n", 1 <= i <= n. Throws BadInput for anything else.
Shard ReadShard(const std::string& text);

/// The description of running `suite`, fully resolved, with this program and its libraries.
RunDescription Describe(const Suite& suite);

// Ctrl-C and kill as a wish: loops look at it and stop where nothing is lost.

/// From here on the first SIGINT, SIGTERM or SIGHUP only sets the wish; a second of the same kind ends
/// the process at once.
void CatchInterrupts();

/// Whether one came since CatchInterrupts.
bool Interrupted();

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
RunOutcome RunSuite(const Suite& suite, const Contestants& contestants, const RunOptions& options,
                    RunStore& store);

}  // namespace warmjoint
