#include "tests/tools/cli/run_program.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "models/foundation/atomic_file.h"
#include "tests/support/folders.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

/// Starts the program with its outputs in files; returns its process number.
pid_t Start(const std::vector<std::string>& arguments, const std::string& out,
            const std::string& err) {
  static const std::string program = test::BuildFolder() / "warmjoint";
  std::vector<const char*> argv{program.c_str()};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  argv.push_back(nullptr);

  const pid_t child = fork();
  if (child != 0) return child;
  const int flags = O_WRONLY | O_CREAT | O_TRUNC;
  dup2(open(out.c_str(), flags, 0600), STDOUT_FILENO);
  dup2(open(err.c_str(), flags, 0600), STDERR_FILENO);
  execv(program.c_str(), const_cast<char* const*>(argv.data()));
  _exit(127);
}

int Wait(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

Answer RunWarmjoint(const std::vector<std::string>& arguments) {
  const ScratchDirectory scratch;
  const std::string out = scratch.path() / "out";
  const std::string err = scratch.path() / "err";
  const int status = Wait(Start(arguments, out, err));
  return {status, ReadWholeFile(out), ReadWholeFile(err)};
}

int RunAndSignal(const std::vector<std::string>& arguments, int signal, double delay) {
  const pid_t child = Start(arguments, "/dev/null", "/dev/null");
  std::this_thread::sleep_for(std::chrono::duration<double>(delay));
  kill(child, signal);
  return Wait(child);
}

}  // namespace warmjoint
