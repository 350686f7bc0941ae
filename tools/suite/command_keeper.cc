#include "tools/suite/command_keeper.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace warmjoint::inline tools {
namespace {

constexpr int kNoStart = 127;  // exit status of a command that cannot be started, as shells have it
constexpr long kLongestPause = 20'000'000;  // ns
constexpr int kLevels = 16;                 // of processes below processes that are counted
constexpr int kMostReaped = 64;             // ended processes between two looks at the limits

double Now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void Limit(int resource, rlim_t value) {
  rlimit limit{};
  getrlimit(static_cast<__rlimit_resource>(resource), &limit);
  limit.rlim_cur = limit.rlim_max = std::min(value, limit.rlim_max);
  setrlimit(static_cast<__rlimit_resource>(resource), &limit);
}

/// Closes all descriptors but the standard three and those named.
void CloseOthers(int a, int b, int c) {
  // all files but the kept ones are closed, gap by gap
  int kept[]{a, b, c};
  std::sort(kept, kept + 3);
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

/// The command itself, from fork to exec.
[[noreturn]] void BecomeCommand(const KeeperTask& task) noexcept {
  // a session of its own, which dies with its keeper
  setsid();
  prctl(PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0);
  // it has nothing to read, and all that it writes goes to the keeper's pipe
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(task.output, STDOUT_FILENO);
  dup2(task.output, STDERR_FILENO);

  // signals as a fresh process has them
  for (int signal = 1; signal < NSIG; ++signal) ::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);

  // limits that the kernel watches
  Limit(RLIMIT_CPU, static_cast<rlim_t>(std::ceil(task.limits.seconds)) + 1);
  Limit(RLIMIT_AS, task.limits.memory);
  Limit(RLIMIT_FSIZE, task.limits.file);
  Limit(RLIMIT_NOFILE, 256);
  Limit(RLIMIT_CORE, 0);
  // the wall is raised last, then the command takes over this process
  if (chdir(task.directory) != 0 || !task.wall->Raise()) _exit(kNoStart);
  CloseOthers(0, 1, 2);
  execve(task.arguments[0], task.arguments, task.environment);
  constexpr char words[] = "the command cannot be started\n";
  [[maybe_unused]] const ssize_t told = write(STDERR_FILENO, words, sizeof words - 1);
  _exit(kNoStart);
}

/// "/proc/PID/task/PID/children", made without a library that may hold locks.
struct ChildrenPath {
  explicit ChildrenPath(pid_t pid) {
    // written without the heap, which a fork may leave locked
    char digits[12] = {};
    char* first = digits + 11;
    for (pid_t rest = pid; rest > 0; rest /= 10) *--first = static_cast<char>('0' + rest % 10);
    for (const char* part : {"/proc/", const_cast<const char*>(first), "/task/",
                             const_cast<const char*>(first), "/children"}) {
      while (*part) text[size++] = *part++;
    }
  }

  char text[64] = {};
  int size = 0;
};

/// Calls work(pid) for each child of a process that has one thread.
template <typename Work>
void ForEachChild(pid_t parent, Work work) {
  const int file = open(ChildrenPath(parent).text, O_RDONLY | O_CLOEXEC);
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

/// Kills what is left of the command. Killing a process hands its children to this one, which
/// has adopted all of them once nothing is left to wait for.
void KillAll(pid_t command) {
  // its group at once, then whoever left the group, until nobody is left
  kill(-command, SIGKILL);
  for (;;) {
    ForEachChild(getpid(), [](pid_t pid) { kill(pid, SIGKILL); });
    // all that ended, since there may be thousands
    pid_t ended = 1;
    while (ended > 0) ended = waitpid(-1, nullptr, WNOHANG);
    if (ended < 0) return;
    const timespec pause{0, 200'000};
    nanosleep(&pause, nullptr);
  }
}

}  // namespace

void KeepCommand(const KeeperTask& task, pid_t parent) noexcept {
  // processes that lose their parent become children of this one
  setsid();
  prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0);
  CloseOthers(task.output, task.verdict, task.wall->descriptor());
  const double deadline = Now() + task.limits.seconds;

  KeeperVerdict verdict;
  const pid_t command = fork();
  // this side only watches; the pipe is the command's
  if (command == 0) BecomeCommand(task);
  close(task.output);
  bool abandoned = false;
  timespec pause{0, 200'000};
  while (command > 0) {
    // reap orphans too; where they end faster than that, the limits are looked at all the same
    pid_t ended = 1;
    for (int i = 0; i < kMostReaped && ended > 0 && ended != command; ++i) {
      int status = 0;
      ended = waitpid(-1, &status, WNOHANG);
      if (ended == command) verdict.status = status;
    }
    if (ended == command || ended < 0) break;
    // what ends it: nobody waits any more, its time is over, its processes are too many
    abandoned = getppid() != parent;
    verdict.timed_out = Now() > deadline;
    verdict.crowded = CountBelow(getpid(), kLevels, task.limits.processes) > task.limits.processes;
    if (abandoned || verdict.timed_out || verdict.crowded) break;
    // quick commands are noticed at once, long ones cost little to watch
    nanosleep(&pause, nullptr);
    pause.tv_nsec = std::min(2 * pause.tv_nsec, kLongestPause);
  }

  // nothing that the command started survives it
  if (command > 0) KillAll(command);
  // where nobody waits, nobody else removes its directory
  if (abandoned) execve(task.removal[0], task.removal, task.environment);
  if (command < 0) verdict.status = kNoStart << 8;
  [[maybe_unused]] const ssize_t told = write(task.verdict, &verdict, sizeof verdict);
  _exit(0);
}

}  // namespace warmjoint::inline tools
