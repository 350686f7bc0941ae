#include "tools/suite/run_command.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <vector>

#include "models/foundation/atomic_file.h"

namespace warmjoint::inline tools {
namespace {

/// What a process starts with; the system's calls release it.
struct SpawnSetup {
  SpawnSetup(const std::filesystem::path& directory) {
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, directory.c_str());
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "output.txt",
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);

    // a group of its own: one signal ends all that the command starts, Ctrl-C passes it by
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
  }
  ~SpawnSetup() {
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnSetup(const SpawnSetup&) = delete;
  SpawnSetup& operator=(const SpawnSetup&) = delete;

  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
};

/// Our environment with one thread for each numerical library.
std::vector<char*> Environment() {
  static char one_thread[][32] = {"OMP_NUM_THREADS=1", "OPENBLAS_NUM_THREADS=1",
                                  "MKL_NUM_THREADS=1"};
  std::vector<char*> environment;
  for (auto& variable : one_thread) environment.push_back(variable);
  for (char** variable = environ; *variable; ++variable) {
    if (std::string_view(*variable).find("_NUM_THREADS=") == std::string_view::npos) {
      environment.push_back(*variable);
    }
  }
  environment.push_back(nullptr);
  return environment;
}

pid_t Start(const std::string& command, const std::filesystem::path& directory) {
  const SpawnSetup setup(directory);
  std::string shell = "sh", option = "-c", text = command;
  char* arguments[] = {shell.data(), option.data(), text.data(), nullptr};
  std::vector<char*> environment = Environment();
  pid_t child = 0;
  const int error = posix_spawn(&child, "/bin/sh", &setup.actions, &setup.attributes, arguments,
                                environment.data());
  if (error != 0) throw std::runtime_error(std::string("cannot start sh: ") + strerror(error));
  return child;
}

std::string LastLine(const std::string& text) {
  const size_t end = text.find_last_not_of(" \n\r");
  if (end == std::string::npos) return "";
  const size_t begin = text.find_last_of('\n', end);
  return text.substr(begin == std::string::npos ? 0 : begin + 1, end - (begin + 1) + 1);
}

}  // namespace

CommandEnd RunShellCommand(const std::string& command, const std::filesystem::path& directory,
                           double limit) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                        std::chrono::duration<double>(limit));
  const pid_t child = Start(command, directory);

  // poll often at first, for quick commands
  CommandEnd end;
  int status = 0;
  std::chrono::microseconds pause{200};
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (Clock::now() > deadline) {
      end.timed_out = true;
      kill(-child, SIGKILL);
      waitpid(child, &status, 0);
      break;
    }
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, std::chrono::microseconds{20000});
  }

  // nothing of it lives on
  kill(-child, SIGKILL);
  end.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  end.last_output = LastLine(ReadWholeFile(directory / "output.txt"));
  return end;
}

}  // namespace warmjoint::inline tools
