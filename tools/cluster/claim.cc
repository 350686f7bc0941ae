#include "tools/cluster/claim.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "models/foundation/atomic_file.h"
#include "tools/suite/interrupt.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;
namespace {

/// Who a task is: a requeued one is the same again.
std::string Owner() {
  const char* job = std::getenv("SLURM_ARRAY_JOB_ID");
  const char* index = std::getenv("SLURM_ARRAY_TASK_ID");
  if (job && index) return fmt::format("{}_{}", job, index);
  return fmt::format("{}:{}", HostName(), getpid());
}

/// Whether the owner is a process of this machine that has ended.
bool IsGone(const std::string& owner) {
  const std::string prefix = HostName() + ":";
  if (!owner.starts_with(prefix)) return false;
  return kill(std::atoi(owner.c_str() + prefix.size()), 0) != 0 && errno == ESRCH;
}

}  // namespace

std::string HostName() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

Claim LookAt(const fs::path& folder, double patience) {
  // while its state says that someone else is at work, wait for a sign of life
  const auto first = ReadShardState(folder);
  for (auto state = first; state; state = ReadShardState(folder)) {
    if (state->phase == Phase::done) return Claim::done;
    if (state->phase == Phase::failed) return Claim::failed;
    // an earlier life of this task, or an owner that has ended, does not hold the shard
    const bool ours = state->owner == Owner() || IsGone(state->owner);
    if (state->phase != Phase::running || ours) return Claim::free;
    // a later time stamp is a sign of life; whoever was silent for too long was killed
    if (state->updated > first->updated) return Claim::taken;
    if (Now() - state->updated > patience) return Claim::free;
    if (Interrupted()) return Claim::interrupted;
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  return Claim::free;
}

ShardState TakeOver(const fs::path& folder) {
  // what a killed task was writing
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::error_code ignored;
    if (IsUnderConstruction(entry.path())) fs::remove(entry.path(), ignored);
  }

  // the counts of earlier tasks go on
  ShardState state = ReadShardState(folder).value_or(ShardState());
  state.owner = Owner();
  state.host = HostName();
  return state;
}

void NoteRefusal(const fs::path& folder, const std::string& words) {
  ShardState state = ReadShardState(folder).value_or(ShardState());
  state.phase = Phase::interrupted;
  state.last_words = words;
  state.updated = Now();
  WriteShardState(folder, state);
}

}  // namespace warmjoint::inline tools
