// Commands of others: each in a directory of its own, in a sandbox, under limits.
#pragma once

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "tools/suite/sandbox.h"

namespace warmjoint {

/// A file in memory that a child process reads or writes. Closed at the end of its life, and at an exec of the child but for copies of its descriptor.
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

/// What a command may use.
struct CommandLimits {
  double seconds = 60;                         // of wall time, and of each process's computing
  std::size_t memory = std::size_t{4} << 30;   // bytes of address space of each process
  std::size_t file = std::size_t{256} << 20;   // bytes of each file that it writes
  std::size_t output = std::size_t{64} << 20;  // bytes on standard output and error together
  std::size_t answer = std::size_t{16} << 20;  // bytes of its answer
  int processes = 64;                          // at a time, threads not counted
};

/// A file that the command finds in its directory.
struct CommandFile {
  std::string name, content;
};

struct CommandTask {
  std::vector<std::string> arguments;  // the first is the program
  std::vector<CommandFile> files;
  std::string answer;                           // name of the file that it is to write
  std::vector<std::filesystem::path> readable;  // by the sandbox, besides its directory
  Confinement confinement = Confinement::sandbox;
  CommandLimits limits;
};

/// What ended a command: itself, a limit, or that it could not be started.
enum class CommandEnding { by_itself, timeout, processes, output };

/// What lies under the name of the answer.
enum class AnswerKind { absent, no_file, too_large, whole };

/// How a command ended, and what it left.
struct CommandEnd {
  CommandEnding ending = CommandEnding::by_itself;
  int status = 0;  // exit status; 128 + signal where one ended it; 126 and 127 as shells have them
  std::string
      last_output;  // last line that it wrote, 4 KiB of it at most; its directory in it is "."
  AnswerKind kind = AnswerKind::absent;
  std::string answer;  // where it is whole
};

/// The file of a program: as it is where it names a folder, else the first in PATH that can be run.
std::string FindProgram(const std::string& name);

/// Runs a command in a fresh directory with nothing but `files`, in a session of its own, with standard input empty and a
/// short list of environment variables; numerical libraries get one thread. However it ends, by itself, by a limit or with
/// this process, killed or not: none of the processes that it started lives on, and its directory goes. Throws system_error
/// where no process can be made, OutputFailed where the directory cannot be filled. Safe on many threads.
CommandEnd RunCommand(const CommandTask& task);

}  // namespace warmjoint
