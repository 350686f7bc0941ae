// The process between this program and a command of others.
#pragma once

#include <sys/types.h>

#include "tools/suite/run_command.h"

namespace warmjoint {

/// What the supervisor tells, in memory that it shares with this program.
struct Verdict {
  int error = 0;   // errno of a directory that could not be filled; 0: it was
  int status = 0;  // of waitpid
  CommandEnding ending = CommandEnding::by_itself;
  AnswerKind answer = AnswerKind::absent;
};

/// All that a supervisor needs, made before it is forked: between fork and exec only system calls may be made, since other
/// threads may have held any lock.
struct Supervision {
  const CommandTask& task;
  const Sandbox& sandbox;
  char* const* arguments;    // of the command, ended by nullptr; the first is a path
  char* const* environment;  // ended by nullptr
  char* const* removal;      // arguments of a program that removes the directory
  const char* directory;     // does not exist yet
  int output = -1;           // gets what the command writes
  int answer = -1;           // gets the file that it leaves as its answer
  Verdict* verdict = nullptr;
};

/// The supervisor's whole life: makes and fills the directory, starts the command, waits for it, kills all that came of it,
/// takes its answer, and becomes the program that removes the directory. It adopts orphans, so that no child escapes by
/// losing its parent; a command whose `parent` ended is ended, too.
[[noreturn]] void Supervise(const Supervision& supervision, pid_t parent) noexcept;

}  // namespace warmjoint
