// How far a shard is, in a file that its task keeps up to date.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace warmjoint::inline tools {

enum class Phase {
  running,      // a task is at work, or was when it was killed: `updated` tells
  interrupted,  // ended before the end: time limit, Ctrl-C, a machine that calculates otherwise
  failed,       // started too often without finishing a realization
  done,
};

/// RUN/shards/NUMBER/state.json.
struct ShardState {
  Phase phase = Phase::running;
  int finished = 0;                     // units (realizations of all variants) in the run's copy
  int total = 0;                        // of the shard
  std::map<std::string, int> failures;  // of identifiers: status: count
  double rate = 0;                      // units a second since this task started; 0 unknown
  int starts = 0;                       // of all tasks of this shard
  int idle_starts = 0;                  // of them, since the last realization was finished
  std::string owner;                    // array job and index, else host and process
  std::string host;
  double updated = 0;      // s since 1970
  std::string last_words;  // of what ended it
};

/// Nothing where no task has started yet. Throws BadInput for a file that is no state.
std::optional<ShardState> ReadShardState(const std::filesystem::path& folder);

void WriteShardState(const std::filesystem::path& folder, const ShardState& state);

/// A person who starts a shard again gives it all its starts again, failed or not.
void Forgive(const std::filesystem::path& folder);

/// Now, s since 1970.
double Now();

/// The longest silence of a task that is at work, s: three times between its checkpoints, and time for
/// a slow file system.
double Patience(double checkpoint_seconds);

}  // namespace warmjoint::inline tools
