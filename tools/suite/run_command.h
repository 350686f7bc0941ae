// Commands of others, kept on a short leash.
#pragma once

#include <filesystem>
#include <string>

namespace warmjoint::inline tools {

/// How a command ended.
struct CommandEnd {
  bool timed_out = false;
  int status = 0;           // exit status; 128 + signal where one ended it
  std::string last_output;  // last line that it wrote
};

/// Runs `command` in a shell in `directory`, which gets its output as output.txt. After `limit`
/// seconds it is killed with all processes that it started. Numerical libraries get one thread.
CommandEnd RunShellCommand(const std::string& command, const std::filesystem::path& directory,
                           double limit);

}  // namespace warmjoint::inline tools
