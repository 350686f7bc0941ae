// A file in memory that a child process reads or writes.
#pragma once

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

namespace warmjoint {

/// Closed at the end of its life, and at an exec of the child but for copies of its descriptor.
class MemoryFile {
 public:
  /// name: for those who look at a process's open files. Throws std::system_error, as Fill does.
  explicit MemoryFile(const char* name) : file_(memfd_create(name, MFD_CLOEXEC)) {
    Require(file_ >= 0);
  }
  ~MemoryFile() { close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int descriptor() const { return file_; }

  /// Puts bytes into it for a reader that begins with the first.
  void Fill(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t n = write(file_, bytes.data(), bytes.size());
      Require(n >= 0);
      bytes.remove_prefix(static_cast<std::size_t>(n));
    }
    lseek(file_, 0, SEEK_SET);
  }

  /// Its last bytes; all of them where no limit is given.
  std::string Tail(std::size_t most = std::numeric_limits<std::size_t>::max()) const {
    struct stat status {};
    fstat(file_, &status);
    const auto size = static_cast<std::size_t>(status.st_size);
    std::string tail(std::min(most, size), '\0');
    const ssize_t n =
        pread(file_, tail.data(), tail.size(), static_cast<off_t>(size - tail.size()));
    tail.resize(static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
    return tail;
  }

 private:
  static void Require(bool good) {
    if (!good) throw std::system_error(errno, std::generic_category(), "a file in memory");
  }

  int file_;
};

}  // namespace warmjoint
