// Results on their way from a machine's own disk into the run.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "tools/cluster/plan.h"

namespace warmjoint::inline tools {

/// What a store holds of a shard.
struct Tally {
  int finished = 0;                     // units
  std::map<std::string, int> failures;  // of identifiers: status: count
};

/// A copy of a database that another process may be writing to, as it was at one moment. Throws
/// OutputFailed where there is no room.
void TakeSnapshot(const std::filesystem::path& database, const std::filesystem::path& copy);

/// Counts in a store's results that nobody writes to.
Tally TallyOf(const std::filesystem::path& results, const PlannedShard& shard);

/// Copies a file so that the target is the old or the new one as a whole, on disk before it has its name.
void PutFile(const std::filesystem::path& file, const std::filesystem::path& target);

}  // namespace warmjoint::inline tools
