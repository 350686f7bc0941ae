#include "tools/cluster/child.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "tools/suite/run_command.h"
#include "tools/terminal/exec_words.h"

namespace warmjoint::inline tools {
namespace {

constexpr int kNoStart = 127;  // exit status of what cannot be started, as shells have it

int StatusOf(int wait_status) {
  return WIFEXITED(wait_status) ? WEXITSTATUS(wait_status) : 128 + WTERMSIG(wait_status);
}

/// Forks and becomes the program; out and err: descriptors, or -1 for this program's own.
pid_t Start(const std::vector<std::string>& arguments, const std::string& directory, int out,
            int err) {
  // all that needs memory comes before the fork
  std::vector<std::string> words = arguments;
  words.front() = FindProgram(words.front());
  const std::vector<char*> argv = ExecWords(words);
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid < 0) throw std::system_error(errno, std::generic_category(), "no process");
  if (pid > 0) return pid;

  // nothing that this program started outlives it: another of its kind goes on
  prctl(PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0);
  if (getppid() != parent) _exit(kNoStart);
  // signals that this program ignores or catches are the child's own again
  for (int signal = 1; signal < NSIG; ++signal) ::signal(signal, SIG_DFL);
  if (out >= 0) dup2(out, STDOUT_FILENO);
  if (err >= 0) dup2(err, STDERR_FILENO);
  if (!directory.empty() && chdir(directory.c_str()) != 0) _exit(kNoStart);
  execv(argv[0], argv.data());
  _exit(kNoStart);
}

int Wait(pid_t pid) {
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  return StatusOf(status);
}

int MakeMemoryFile(const char* name) {
  const int file = memfd_create(name, MFD_CLOEXEC);
  if (file < 0) throw std::system_error(errno, std::generic_category(), "no file in memory");
  return file;
}

std::string WholeOf(int file) {
  std::string text;
  char block[4096];
  lseek(file, 0, SEEK_SET);
  for (ssize_t n; (n = read(file, block, sizeof block)) > 0;) {
    text.append(block, static_cast<std::size_t>(n));
  }
  close(file);
  return text;
}

}  // namespace

Child::Child(const std::vector<std::string>& arguments, const ChildPlace& place) {
  // its words go into a file that starts empty, or where this program's own go
  const int words = place.words.empty()
                        ? -1
                        : open(place.words.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  pid_ = Start(arguments, place.directory, words, words);
  if (words >= 0) close(words);
}

Child::Child(Child&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), status_(other.status_) {}

Child::~Child() {
  // a child that still runs is not left behind
  if (pid_ < 0 || status_) return;
  Signal(SIGKILL);
  Wait(pid_);
}

std::optional<int> Child::Poll() {
  int status = 0;
  if (!status_ && waitpid(pid_, &status, WNOHANG) == pid_) status_ = StatusOf(status);
  return status_;
}

void Child::Signal(int signal) const {
  if (!status_) kill(pid_, signal);
}

Captured Capture(const std::vector<std::string>& arguments) {
  // into memory: no pipe that fills while nobody reads
  const int out = MakeMemoryFile("out");
  const int err = MakeMemoryFile("err");
  const int status = Wait(Start(arguments, "", out, err));
  return {status, WholeOf(out), WholeOf(err)};
}

}  // namespace warmjoint::inline tools
