// Whose shard it is: tasks that are started twice keep out of each other's way.
#pragma once

#include <filesystem>
#include <string>

#include "tools/cluster/shard_state.h"

namespace warmjoint::inline tools {

enum class Claim {
  free,         // nobody is at work on it
  taken,        // another task is, and gave a sign of life while this one watched
  done,         // it is finished
  failed,       // it was given up
  interrupted,  // another task may be at work: this one was asked to end before it knew
};

/// Looks whether a shard can be taken. Where its state says that another task is at work, it waits for
/// the next sign of life, or until there was none for `patience` s: a killed task's word stands a while.
Claim LookAt(const std::filesystem::path& folder, double patience);

/// The shard's state for a task that begins: counts go on, the owner is this task. Removes what a killed
/// task was writing.
ShardState TakeOver(const std::filesystem::path& folder);

/// Leaves a sentence where no task is at work: why this machine did not take the shard.
void NoteRefusal(const std::filesystem::path& folder, const std::string& words);

std::string HostName();

}  // namespace warmjoint::inline tools
