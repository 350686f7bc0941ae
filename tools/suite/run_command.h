// Commands of others, kept on a short leash.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/suite/wall.h"

namespace warmjoint::inline tools {

/// What a command may use.
struct CommandLimits {
  double seconds = 60;                        // of wall time, and of each process's computing
  std::size_t memory = std::size_t{4} << 30;  // bytes of address space of each process
  std::size_t file = std::size_t{256} << 20;  // bytes of each file that it writes
  int processes = 64;                         // at a time, threads not counted
};

/// The file of a program: as it is where it names a folder, else the first in PATH that can be run.
std::string FindProgram(const std::string& name);

/// How a command ended.
struct CommandEnd {
  bool timed_out = false;
  bool crowded = false;     // ended for its many processes
  int status = 0;           // exit status; 128 + signal where one ended it
  std::string last_output;  // last line that it wrote, 4 KiB of it at most
};

/// Runs `arguments` in `directory` behind `wall`, in a session of its own, with standard input empty
/// and a short list of environment variables; numerical libraries get one thread. However it ends,
/// by itself, by a limit or with this process, killed or not: none of the processes that it
/// started lives on, and where this process is killed the directory goes too. Throws
/// runtime_error where no process can be made. Safe on many threads.
CommandEnd RunCommand(const std::vector<std::string>& arguments,
                      const std::filesystem::path& directory, const Wall& wall,
                      const CommandLimits& limits);

}  // namespace warmjoint::inline tools
