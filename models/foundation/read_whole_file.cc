// Reading of files that may be anything.
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"

namespace warmjoint::inline models {
namespace fs = std::filesystem;
namespace {

constexpr int kPatience = 3;  // s that a pipe may stay silent at first

/// An open file, closed at the end of its life.
class OpenFile {
 public:
  // without blocking, so that a pipe without a writer does not hold the program
  explicit OpenFile(const fs::path& path)
      : file_(IsStandardInput(path)
                  ? fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0)
                  : open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)) {}
  ~OpenFile() {
    if (file_ >= 0) close(file_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  int get() const { return file_; }

 private:
  int file_;
};

/// Waits for the first bytes of a pipe that was named, then reads it as any other file.
void AwaitWriter(int file, const Place& place) {
  pollfd readable{file, POLLIN, 0};
  if (poll(&readable, 1, kPatience * 1000) == 0) {
    Refuse(place, "is a pipe that nobody wrote to within {} s; give a file", kPatience);
  }
  fcntl(file, F_SETFL, fcntl(file, F_GETFL) & ~O_NONBLOCK);
}

/// What the file is; refuses all but regular files and pipes that someone writes to.
struct stat Examine(int file, const fs::path& path, const Place& place) {
  struct stat status {};
  if (fstat(file, &status) != 0 || S_ISDIR(status.st_mode)) {
    Refuse(place, "is a folder; give a file");
  }
  if (S_ISREG(status.st_mode)) return status;
  if (isatty(file)) Refuse(place, "is a terminal; give a file, or send one through a pipe");
  if (!S_ISFIFO(status.st_mode) && !S_ISSOCK(status.st_mode)) {
    Refuse(place, "is a device; give a file");
  }
  if (!IsStandardInput(path)) AwaitWriter(file, place);
  return status;
}

}  // namespace

bool IsStandardInput(const fs::path& path) { return path == "-"; }

std::string InputName(const fs::path& path) {
  return IsStandardInput(path) ? "standard input" : path.string();
}

std::string ReadWholeFile(const fs::path& path, std::size_t most) {
  if (path.empty()) Refuse({"input"}, "the name of a file is empty; give one");
  const Place place{InputName(path)};
  const OpenFile file(path);
  if (file.get() < 0) {
    Refuse(place, "cannot be read ({}); does it exist?", std::generic_category().message(errno));
  }
  const struct stat status = Examine(file.get(), path, place);
  const auto refuse_size = [&] {
    Refuse(place, "has more than the {} MiB that are read at most; cut it", most >> 20);
  };
  if (status.st_size > 0 && static_cast<std::size_t>(status.st_size) > most) refuse_size();

  std::string text;
  text.resize(static_cast<std::size_t>(status.st_size) + 1);  // and room to see its end
  std::size_t filled = 0;
  for (;;) {
    // pipes tell no size, and files may grow
    if (filled == text.size()) text.resize(std::min(most + 1, filled + filled / 2 + 4096));
    const ssize_t n = read(file.get(), text.data() + filled, text.size() - filled);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) Refuse(place, "cannot be read: {}", std::generic_category().message(errno));
    if (n == 0) break;
    filled += static_cast<std::size_t>(n);
    if (filled > most) refuse_size();
  }
  text.resize(filled);
  return text;
}

}  // namespace warmjoint::inline models
