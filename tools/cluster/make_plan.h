// A plan for a suite: shards of a sensible length, by a timed probe.
#pragma once

#include <optional>

#include "scenarios/suite.h"
#include "tools/cluster/plan.h"
#include "tools/suite/following_tally.h"
#include "tools/suite/prepared_identifier.h"

namespace warmjoint::inline tools {

/// Length of a shard where nobody says otherwise, s: a controller starts some 9 tasks a second, so that
/// shorter ones keep it busy; longer ones lose more to a time limit.
inline constexpr double kShardSeconds = 900;

/// What a look at the first realizations tells of the others.
struct Probe {
  double seconds = 0;  // wall time of one realization in all variants on one thread
  FollowingTally following;
};

/// Runs realization 0 in all variants with all identifiers. What takes less than half a second is
/// repeated, and the mean without the first is taken.
Probe ProbeSuite(const Suite& suite, const std::vector<PreparedIdentifier>& identifiers);

/// Number of shards so that one takes kShardSeconds on `jobs` threads; at least 1, at most one a
/// realization.
int ShardCount(int realizations, double probe_seconds, int jobs);

/// Realizations first .. end - 1 in `count` blocks whose sizes differ by 1 at most, one after the
/// other; with more blocks than realizations some are empty.
std::vector<PlannedShard> PartEvenly(int first, int end, int count);

/// The program that runs, and the plugin that lies beside it, with their digests.
PinnedFile ThisProgram();
PinnedFile ThisPlugin();

}  // namespace warmjoint::inline tools
