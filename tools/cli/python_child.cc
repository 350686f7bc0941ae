#include "tools/cli/python_child.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

#include "tools/suite/run_command.h"
#include "tools/terminal/shell_words.h"

namespace warmjoint {

std::vector<std::string> Pythons() {
  if (const char* named = std::getenv("WARMJOINT_PYTHON"); named && *named) return {named};
  return {"python3", "/usr/bin/python3"};
}

Ended CallPython(std::vector<std::string> words, std::string_view input) {
  // three files in memory in place of pipes, which could wait for each other
  MemoryFile in("input"), out("output"), err("error");
  in.Fill(input);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  const int files[] = {in.descriptor(), out.descriptor(), err.descriptor()};
  for (int i = 0; i < 3; ++i) posix_spawn_file_actions_adddup2(&actions, files[i], i);
  const std::vector<char*> arguments = ExecWords(words);

  pid_t child = 0;
  const int failed =
      posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed) return {};
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return {.ran = !(WIFEXITED(status) && WEXITSTATUS(status) == 127),
          .well = WIFEXITED(status) && WEXITSTATUS(status) == 0,
          .signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0,
          .out = out.Tail(),
          .err = err.Tail()};
}

std::string LastLine(std::string text) {
  text.erase(text.find_last_not_of(" \n") + 1);
  return text.substr(text.find_last_of('\n') + 1);
}

}  // namespace warmjoint
