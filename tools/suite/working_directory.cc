#include "tools/suite/working_directory.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <memory>
#include <mutex>
#include <random>
#include <string>
#include <system_error>

#include "models/foundation/output_failed.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;
namespace {

/// Removes a directory once nobody holds the other end of its standard input; again for a while, since commands that are about to
/// be killed may still write there.
constexpr const char* kJanitor =
    "while read -r line; do :; done\n"
    "for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do\n"
    "  rm -rf --one-file-system \"$0\"; [ -e \"$0\" ] || exit 0; sleep 0.2\n"
    "done";

/// A name that nobody else draws.
fs::path DrawnPath() {
  std::random_device random;
  return fs::temp_directory_path() / fmt::format("warmjoint_{:08x}{:08x}", random(), random());
}

/// Where all working directories of this process lie. A shell in a session of its own waits for the end of this process,
/// and removes what it left, also where it was killed; it is there before the directory is.
class Room {
 public:
  Room() : owner_(getpid()), path_(DrawnPath()) {
    // another process tidies up where this one is killed
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) == 0) {
      janitor_ = fork();
      if (janitor_ == 0) BecomeJanitor(ends[0]);
      close(ends[0]);
      alive_ = ends[1];
    }
    if (mkdir(path_.c_str(), 0700) != 0) FailOutput(path_.string(), errno);
  }
  ~Room() {
    // a forked child must not remove what is its parent's
    if (!mine()) return;
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    if (alive_ >= 0) close(alive_);
    if (janitor_ > 0) waitpid(janitor_, nullptr, 0);
  }
  Room(const Room&) = delete;
  Room& operator=(const Room&) = delete;

  const fs::path& path() const { return path_; }
  bool mine() const { return getpid() == owner_; }

 private:
  /// From fork to exec: system calls alone.
  [[noreturn]] void BecomeJanitor(int end) const noexcept {
    // it stays where the session ends or is interrupted
    setsid();
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_IGN);
    const int nothing = open("/dev/null", O_WRONLY);
    // its input ends when this process does
    dup2(end, STDIN_FILENO);
    dup2(nothing, STDOUT_FILENO);
    dup2(nothing, STDERR_FILENO);
    syscall(SYS_close_range, 3u, ~0u, 0);
    execl("/bin/sh", "sh", "-c", kJanitor, path_.c_str(), nullptr);
    _exit(1);
  }

  pid_t owner_;
  fs::path path_;
  pid_t janitor_ = -1;
  int alive_ = -1;  // the end that closes with this process
};

/// This process's; a fork makes one of its own.
fs::path PathOfRoom() {
  static std::mutex mutex;
  static std::unique_ptr<const Room> room;
  const std::lock_guard lock(mutex);
  if (!room || !room->mine()) room = std::make_unique<const Room>();
  return room->path();
}

}  // namespace

WorkingDirectory::WorkingDirectory() {
  const fs::path room = PathOfRoom();
  std::string pattern = room / "XXXXXX";
  char* made = mkdtemp(pattern.data());
  if (!made && errno == ENOENT) {
    // something tidied up during a long run
    mkdir(room.c_str(), 0700);
    pattern = room / "XXXXXX";
    made = mkdtemp(pattern.data());
  }
  if (!made) FailOutput(pattern, errno);
  path_ = pattern;
}

WorkingDirectory::~WorkingDirectory() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace warmjoint::inline tools
