#include "tools/suite/run_command.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <csignal>
#include <cstdlib>
#include <memory>
#include <new>
#include <random>
#include <sstream>

#include "models/foundation/bad_input.h"
#include "tools/suite/supervisor.h"
#include "tools/terminal/shell_words.h"

namespace warmjoint {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void Fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

/// A verdict in memory that a forked process shares.
std::shared_ptr<Verdict> SharedVerdict() {
  void* const memory =
      mmap(nullptr, sizeof(Verdict), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) Fail("no memory for a command");
  // where the supervisor itself is killed, this stands
  return {new (memory) Verdict{.status = SIGKILL},
          [](Verdict* verdict) { munmap(verdict, sizeof(Verdict)); }};
}

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

std::vector<std::string> Environment(const std::string& directory) {
  std::vector<std::string> environment{"OMP_NUM_THREADS=1", "OPENBLAS_NUM_THREADS=1",
                                       "MKL_NUM_THREADS=1"};
  for (const char* name : {"HOME", "TMPDIR", "PWD"}) {
    environment.push_back(std::string(name) + "=" + directory);
  }
  for (char** variable = environ; *variable; ++variable) {
    if (IsPassedOn(*variable)) environment.emplace_back(*variable);
  }
  return environment;
}

/// Within the system's folder for temporary files, a name that nobody else draws.
std::string DrawDirectory() {
  std::random_device random;
  return fs::temp_directory_path() / fmt::format("warmjoint_{:08x}{:08x}", random(), random());
}

std::string LastLine(std::string text) {
  text.erase(text.find_last_not_of(" \n\r") + 1);
  return text.substr(text.find_last_of('\n') + 1);
}

}  // namespace

std::string FindProgram(const std::string& name) {
  if (name.find('/') != std::string::npos) return name;
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "/usr/bin:/bin");
  // the first folder of the path that has it
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path file = fs::path(folder) / name;
    if (access(file.c_str(), X_OK) == 0) return file;
  }
  return name;
}

CommandEnd RunCommand(const CommandTask& task) {
  // all that needs memory, before the fork
  std::vector<std::string> words = task.arguments;
  words.front() = FindProgram(words.front());
  const std::string directory = DrawDirectory();
  std::vector<std::string> environment = Environment(directory);
  std::vector<std::string> removal{"/bin/rm", "-rf", "--one-file-system", directory};
  const std::vector<char*> argv = ExecWords(words), envp = ExecWords(environment),
                           remove = ExecWords(removal);
  const MemoryFile output("command"), answer("command");
  const std::shared_ptr<Verdict> verdict = SharedVerdict();
  const Sandbox sandbox =
      task.confinement == Confinement::sandbox ? Sandbox(task.readable) : Sandbox();
  const Supervision supervision{.task = task,
                                .sandbox = sandbox,
                                .arguments = argv.data(),
                                .environment = envp.data(),
                                .removal = remove.data(),
                                .directory = directory.c_str(),
                                .output = output.descriptor(),
                                .answer = answer.descriptor(),
                                .verdict = verdict.get()};

  // the supervisor starts the command, watches and ends it
  const pid_t parent = getpid();
  const pid_t supervisor = fork();
  if (supervisor == 0) Supervise(supervision, parent);
  if (supervisor < 0) Fail("no process for a command");
  while (waitpid(supervisor, nullptr, 0) < 0 && errno == EINTR) continue;
  const Verdict& told = *verdict;
  if (told.error != 0) FailOutput(directory, told.error);

  // an end by a signal as a shell counts it; the directory's name is drawn anew each time, results are not
  constexpr std::size_t kTail = 4096;
  CommandEnd end;
  end.ending = told.ending;
  end.status = WIFEXITED(told.status) ? WEXITSTATUS(told.status) : 128 + WTERMSIG(told.status);
  end.last_output = Replaced(LastLine(output.Tail(kTail)), directory, ".");
  end.kind = told.answer;
  if (told.answer == AnswerKind::whole) end.answer = answer.Tail(task.limits.answer);
  return end;
}

}  // namespace warmjoint
