#include "tests/tools/cli/run_program.h"

#include <fcntl.h>
#include <pty.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>

#include "models/foundation/atomic_file.h"
#include "tests/support/folders.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

/// In the child: becomes the command.
[[noreturn]] void Become(const std::vector<std::string>& words, const Surroundings& where) {
  std::vector<const char*> argv;
  for (const std::string& word : words) argv.push_back(word.c_str());
  argv.push_back(nullptr);
  for (const char* name : {"COLUMNS", "NO_COLOR"}) unsetenv(name);
  for (const auto& [name, value] : where.environment) setenv(name.c_str(), value.c_str(), 1);
  if (where.folder.empty() || chdir(where.folder.c_str()) == 0) {
    execvp(argv[0], const_cast<char* const*>(argv.data()));
  }
  _exit(127);
}

/// Starts a command with its outputs in files; returns its process number.
pid_t Start(const std::vector<std::string>& words, const std::string& out, const std::string& err,
            const Surroundings& where) {
  const pid_t child = fork();
  if (child != 0) return child;
  const int flags = O_WRONLY | O_CREAT | O_TRUNC;
  dup2(open(out.c_str(), flags, 0600), STDOUT_FILENO);
  dup2(open(err.c_str(), flags, 0600), STDERR_FILENO);
  Become(words, where);
}

int Wait(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::vector<std::string> WithProgram(const std::vector<std::string>& arguments) {
  return With({test::BuildFolder() / "warmjoint"}, arguments);
}

}  // namespace

std::vector<std::string> With(std::vector<std::string> words,
                              const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

ProgramAnswer RunCommandLine(const std::vector<std::string>& words, const Surroundings& where) {
  const ScratchDirectory scratch;
  const std::string out = scratch.path() / "out";
  const std::string err = scratch.path() / "err";
  const int status = Wait(Start(words, out, err, where));
  return {status, ReadWholeFile(out), ReadWholeFile(err)};
}

ProgramAnswer RunWarmjoint(const std::vector<std::string>& arguments, const Surroundings& where) {
  return RunCommandLine(WithProgram(arguments), where);
}

bool TerminalsCanBeOpened() {
  int ours = -1, theirs = -1;
  if (openpty(&ours, &theirs, nullptr, nullptr, nullptr) != 0) return false;
  close(ours);
  close(theirs);
  return true;
}

ProgramAnswer RunOnTerminal(const std::vector<std::string>& arguments, int columns,
                            const Surroundings& where) {
  const std::vector<std::string> words = WithProgram(arguments);
  const winsize size{24, static_cast<unsigned short>(columns), 0, 0};
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
  if (child == 0) Become(words, where);
  if (child < 0) throw std::system_error(errno, std::generic_category(), "no pseudo-terminal");

  // all that is shown, until the child has closed its side
  ProgramAnswer answer;
  std::array<char, 4096> block;
  for (ssize_t n; (n = read(terminal, block.data(), block.size())) > 0;) {
    answer.out.append(block.data(), static_cast<std::size_t>(n));
  }
  close(terminal);
  answer.status = Wait(child);
  return answer;
}

int RunAndSignal(const std::vector<std::string>& arguments, int signal, double delay) {
  const pid_t child = Start(WithProgram(arguments), "/dev/null", "/dev/null", {});
  std::this_thread::sleep_for(std::chrono::duration<double>(delay));
  kill(child, signal);
  return Wait(child);
}

}  // namespace warmjoint
