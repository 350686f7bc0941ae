// The process between this program and a command of others.
#pragma once

#include <sys/types.h>

#include "tools/suite/run_command.h"

namespace warmjoint::inline tools {

/// All that a keeper needs, made before it is forked: between fork and exec only system calls may be
/// made, since other threads may have held any lock.
struct KeeperTask {
  char* const* arguments;    // of the command, ended by nullptr; the first is a path
  char* const* environment;  // ended by nullptr
  const char* directory;
  char* const* removal;  // arguments of a command that removes the directory
  const Wall* wall;
  CommandLimits limits;
  int output;   // gets what the command writes
  int verdict;  // gets one KeeperVerdict
};

/// How the command ended.
struct KeeperVerdict {
  int status = 0;  // of waitpid
  bool timed_out = false;
  bool crowded = false;
};

/// The keeper's whole life: starts the command, waits for it, kills all that came of it, and reports. It
/// adopts orphans, so that no child escapes by losing its parent, and ends when `parent` does.
[[noreturn]] void KeepCommand(const KeeperTask& task, pid_t parent) noexcept;

}  // namespace warmjoint::inline tools
