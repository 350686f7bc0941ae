#include "tools/suite/supervisor.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <string_view>

namespace warmjoint {
namespace {

constexpr int kNotExecutable = 126, kNoStart = 127;  // exit statuses, as shells have them
constexpr long kShortestPause = 200'000, kLongestPause = 20'000'000;  // ns
constexpr int kLevels = 16;      // of processes below processes that are counted
constexpr int kMostReaped = 64;  // ended processes between two looks at the limits

double Now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

bool WriteAll(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// Closes all descriptors but the standard three and those named; -1 names none.
void CloseOthers(std::array<int, 3> kept) {
  std::sort(kept.begin(), kept.end());
  unsigned next = 3;
  for (const int file : kept) {
    if (file < static_cast<int>(next)) continue;
    if (file > static_cast<int>(next)) {
      syscall(SYS_close_range, next, static_cast<unsigned>(file) - 1, 0);
    }
    next = static_cast<unsigned>(file) + 1;
  }
  syscall(SYS_close_range, next, ~0u, 0);
}

/// Makes the directory with its files, and goes there; false, with errno, where that fails.
bool FillDirectory(const Supervision& supervision) {
  if (mkdir(supervision.directory, 0700) != 0 || chdir(supervision.directory) != 0) return false;
  for (const CommandFile& file : supervision.task.files) {
    const int made = open(file.name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (made < 0 || !WriteAll(made, file.content) || close(made) != 0) return false;
  }
  return true;
}

void Limit(int resource, rlim_t value) {
  rlimit limit{};
  getrlimit(static_cast<__rlimit_resource>(resource), &limit);
  limit.rlim_cur = limit.rlim_max = std::min(value, limit.rlim_max);
  setrlimit(static_cast<__rlimit_resource>(resource), &limit);
}

/// The command itself, from fork to exec.
[[noreturn]] void BecomeCommand(const Supervision& supervision) noexcept {
  // a session of its own, which dies with its supervisor; all that it writes goes into one file
  setsid();
  prctl(PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0);
  dup2(supervision.output, STDOUT_FILENO);
  dup2(supervision.output, STDERR_FILENO);

  // signals as a fresh process has them
  for (int signal = 1; signal < NSIG; ++signal) ::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);

  // limits that the kernel watches
  const CommandLimits& limits = supervision.task.limits;
  Limit(RLIMIT_CPU, static_cast<rlim_t>(std::ceil(limits.seconds)) + 1);
  Limit(RLIMIT_AS, limits.memory);
  Limit(RLIMIT_FSIZE, limits.file);
  Limit(RLIMIT_NOFILE, 256);
  Limit(RLIMIT_CORE, 0);
  // the sandbox comes last, then the command takes over this process
  if (!supervision.sandbox.Enter(supervision.directory)) _exit(kNoStart);
  CloseOthers({-1, -1, -1});
  execve(supervision.arguments[0], supervision.arguments, supervision.environment);
  const int status = errno == EACCES ? kNotExecutable : kNoStart;
  WriteAll(STDERR_FILENO, "the command cannot be started\n");
  _exit(status);
}

/// Calls work(pid) for each child of a process that has one thread.
template <typename Work>
void ForEachChild(pid_t parent, Work work) {
  char path[64] = {};
  fmt::format_to_n(path, sizeof path - 1, "/proc/{0}/task/{0}/children", parent);
  const int file = open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  char block[512];
  pid_t pid = 0;
  // the kernel lists children as numbers with blanks between
  for (ssize_t n; (n = read(file, block, sizeof block)) > 0;) {
    for (ssize_t i = 0; i < n; ++i) {
      if ('0' <= block[i] && block[i] <= '9') {
        pid = 10 * pid + (block[i] - '0');
      } else if (pid > 0) {
        work(pid);
        pid = 0;
      }
    }
  }
  close(file);
}

/// Number of processes below `parent`, down to some levels; beyond `most` it stops to look deeper.
int CountBelow(pid_t parent, int levels, int most) {
  int count = 0;
  ForEachChild(parent, [&](pid_t pid) {
    count += 1;
    if (levels > 0 && count <= most) count += CountBelow(pid, levels - 1, most - count);
  });
  return count;
}

/// Whether a limit is crossed that the kernel does not watch.
CommandEnding CrossedLimit(const Supervision& supervision, double deadline) {
  const CommandLimits& limits = supervision.task.limits;
  struct stat output {};
  fstat(supervision.output, &output);
  if (static_cast<std::size_t>(output.st_size) > limits.output) return CommandEnding::output;
  if (CountBelow(getpid(), kLevels, limits.processes) > limits.processes) {
    return CommandEnding::processes;
  }
  return Now() > deadline ? CommandEnding::timeout : CommandEnding::by_itself;
}

/// Waits for the command's end by itself, by a limit, or because nobody waits for it any more.
void Watch(const Supervision& supervision, pid_t command, pid_t parent) {
  const double deadline = Now() + supervision.task.limits.seconds;
  Verdict& verdict = *supervision.verdict;
  timespec pause{0, kShortestPause};
  while (getppid() == parent) {
    // reap orphans too; where they end faster than that, the limits are looked at all the same
    pid_t ended = 1;
    for (int i = 0; i < kMostReaped && ended > 0; ++i) {
      ended = waitpid(-1, &verdict.status, WNOHANG);
      if (ended == command) return;
    }
    verdict.ending = CrossedLimit(supervision, deadline);
    if (verdict.ending != CommandEnding::by_itself) return;
    // quick commands are noticed at once, long ones cost little to watch
    nanosleep(&pause, nullptr);
    pause.tv_nsec = std::min(2 * pause.tv_nsec, kLongestPause);
  }
}

/// Kills what is left of the command. Killing a process hands its children to this one, which has adopted all of them
/// once nothing is left to wait for.
void KillAll(pid_t command) {
  // its group at once, then whoever left the group, until nobody is left
  kill(-command, SIGKILL);
  for (;;) {
    ForEachChild(getpid(), [](pid_t pid) { kill(pid, SIGKILL); });
    // all that ended, since there may be thousands
    pid_t ended = 1;
    while (ended > 0) ended = waitpid(-1, nullptr, WNOHANG);
    if (ended < 0) return;
    const timespec pause{0, kShortestPause};
    nanosleep(&pause, nullptr);
  }
}

/// Copies the answer: only a plain file of bounded size is one.
AnswerKind TakeAnswer(const Supervision& supervision) {
  const int file =
      open(supervision.task.answer.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return errno == ENOENT ? AnswerKind::absent : AnswerKind::no_file;
  struct stat status {};
  if (fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) return AnswerKind::no_file;
  if (static_cast<std::size_t>(status.st_size) > supervision.task.limits.answer) {
    return AnswerKind::too_large;
  }
  std::array<char, 1 << 16> block;
  for (ssize_t n; (n = read(file, block.data(), block.size())) > 0;) {
    WriteAll(supervision.answer, {block.data(), static_cast<std::size_t>(n)});
  }
  return AnswerKind::whole;
}

}  // namespace

void Supervise(const Supervision& supervision, pid_t parent) noexcept {
  // processes that lose their parent become children of this one, which shares nothing with the program
  setsid();
  prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0);
  const int nothing = open("/dev/null", O_RDWR);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nothing, standard);
  CloseOthers({supervision.output, supervision.answer, supervision.sandbox.descriptor()});

  // nothing that the command started survives it
  Verdict& verdict = *supervision.verdict;
  if (FillDirectory(supervision)) {
    const pid_t command = fork();
    if (command == 0) BecomeCommand(supervision);
    if (command > 0) {
      Watch(supervision, command, parent);
      KillAll(command);
      verdict.answer = TakeAnswer(supervision);
    } else {
      verdict.status = kNoStart << 8;
    }
  } else {
    verdict.error = errno;
  }

  // the directory goes in any case
  [[maybe_unused]] const int left = chdir("/");
  execve(supervision.removal[0], supervision.removal, supervision.environment);
  _exit(0);
}

}  // namespace warmjoint
