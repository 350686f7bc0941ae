#include "tools/suite/run_command.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "tools/suite/command_keeper.h"
#include "tools/terminal/exec_words.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kTail = 4096;  // bytes of output that are kept

/// Both ends of a pipe, closed at the end of its life.
class Pipe {
 public:
  Pipe() {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0) {
      throw std::system_error(errno, std::generic_category(), "no pipe for a command");
    }
  }
  ~Pipe() { CloseBoth(); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int out() const { return ends_[0]; }
  int in() const { return ends_[1]; }
  void CloseIn() { Close(ends_[1]); }

 private:
  static void Close(int& end) {
    if (end >= 0) close(std::exchange(end, -1));
  }
  void CloseBoth() {
    Close(ends_[0]);
    Close(ends_[1]);
  }

  std::array<int, 2> ends_{-1, -1};
};

/// Whether a command of others gets this variable of ours: where programs and libraries are found
/// and how text is written, nothing that tells of this program or its files.
bool IsPassedOn(std::string_view variable) {
  constexpr std::string_view names[]{
      "PATH",       "LANG",        "TZ",           "LD_LIBRARY_PATH",  "PYTHONPATH",
      "PYTHONHOME", "VIRTUAL_ENV", "CONDA_PREFIX", "JULIA_DEPOT_PATH", "R_HOME",
      "LANGUAGE"};
  const std::string_view name = variable.substr(0, variable.find('='));
  return name.starts_with("LC_") || name.starts_with("IDENTIFIER_") ||
         std::find(std::begin(names), std::end(names), name) != std::end(names);
}

std::vector<std::string> Environment(const fs::path& directory) {
  std::vector<std::string> environment{"OMP_NUM_THREADS=1", "OPENBLAS_NUM_THREADS=1",
                                       "MKL_NUM_THREADS=1"};
  for (const char* name : {"HOME", "TMPDIR", "PWD"}) {
    environment.push_back(std::string(name) + "=" + directory.string());
  }
  for (char** variable = environ; *variable; ++variable) {
    if (IsPassedOn(*variable)) environment.emplace_back(*variable);
  }
  return environment;
}

/// Adds what can be read at once to a tail of bounded size; false at the end, and where there is
/// nothing to be read from a file that does not block.
bool ReadSome(int file, std::string& tail) {
  std::array<char, 65536> block;
  const ssize_t n = read(file, block.data(), block.size());
  if (n < 0) return errno == EINTR;
  tail.append(block.data(), static_cast<std::size_t>(n));
  if (tail.size() > kTail) tail.erase(0, tail.size() - kTail);
  return n > 0;
}

/// Takes the output until the keeper's verdict comes; what a command writes never stops it.
KeeperVerdict Await(const Pipe& output, const Pipe& verdict, std::string& tail) {
  KeeperVerdict end;
  end.status = SIGKILL;  // as waitpid has it: of a keeper that was killed itself
  bool writing = true;
  for (;;) {
    // whatever comes first, words of the command or the verdict on it
    std::array<pollfd, 2> files{pollfd{verdict.out(), POLLIN, 0},
                                pollfd{writing ? output.out() : -1, POLLIN, 0}};
    if (poll(files.data(), files.size(), -1) < 0) {
      if (errno == EINTR) continue;
      break;
    }
    if (files[1].revents != 0) writing = ReadSome(output.out(), tail);
    if (files[0].revents == 0) continue;
    // the verdict comes last
    KeeperVerdict told;
    if (read(verdict.out(), &told, sizeof told) == sizeof told) end = told;
    break;
  }

  // all that wrote is dead: what is in the pipe is all there is
  fcntl(output.out(), F_SETFL, O_NONBLOCK);
  constexpr int kMostReads = 64;  // more than a pipe holds
  for (int i = 0; writing && i < kMostReads; ++i) writing = ReadSome(output.out(), tail);
  return end;
}

std::string LastLine(const std::string& text) {
  const size_t end = text.find_last_not_of(" \n\r");
  if (end == std::string::npos) return "";
  const size_t begin = text.find_last_of('\n', end);
  return text.substr(begin == std::string::npos ? 0 : begin + 1, end - (begin + 1) + 1);
}

}  // namespace

std::string FindProgram(const std::string& name) {
  if (name.find('/') != std::string::npos) return name;
  const char* path = std::getenv("PATH");
  std::string_view rest = path ? path : "/usr/bin:/bin";
  // the first folder of the path that has it
  while (!rest.empty()) {
    const std::size_t colon = rest.find(':');
    const fs::path file = fs::path(rest.substr(0, colon)) / name;
    if (access(file.c_str(), X_OK) == 0) return file;
    rest.remove_prefix(colon == std::string_view::npos ? rest.size() : colon + 1);
  }
  return name;
}

CommandEnd RunCommand(const std::vector<std::string>& arguments, const fs::path& directory,
                      const Wall& wall, const CommandLimits& limits) {
  // all that needs memory, before the fork
  std::vector<std::string> words = wall.Around(arguments);
  words.front() = FindProgram(words.front());
  std::vector<std::string> environment = Environment(directory);
  std::vector<std::string> removal{"/bin/rm", "-rf", "--one-file-system", directory};
  const std::vector<char*> argv = ExecWords(words), envp = ExecWords(environment),
                           remove = ExecWords(removal);
  Pipe output, verdict;
  const std::string folder = directory;
  const KeeperTask task{argv.data(), envp.data(), folder.c_str(), remove.data(),
                        &wall,       limits,      output.in(),    verdict.in()};
  // a keeper in between starts the command, watches and ends it
  const pid_t parent = getpid();
  const pid_t keeper = fork();
  if (keeper == 0) KeepCommand(task, parent);
  if (keeper < 0)
    throw std::system_error(errno, std::generic_category(), "no process for a command");
  // nothing here can write any more, so that reading ends when all others have ended
  output.CloseIn();
  verdict.CloseIn();

  std::string tail;
  const KeeperVerdict end = Await(output, verdict, tail);
  waitpid(keeper, nullptr, 0);
  // an end by a signal as a shell counts it
  const int status = WIFEXITED(end.status) ? WEXITSTATUS(end.status) : 128 + WTERMSIG(end.status);
  return {end.timed_out, end.crowded, status, LastLine(tail)};
}

}  // namespace warmjoint::inline tools
