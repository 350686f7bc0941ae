#include "tools/suite/bubble.h"

#include "tools/suite/run_command.h"
#include "tools/suite/working_directory.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;
namespace {

constexpr double kPatience = 5;  // s, for a trial

/// Whether it can make its namespaces here, and show the system's files and processes in them.
bool Works(const fs::path& program) {
  const WorkingDirectory directory;  // which goes where the trial is killed
  CommandLimits limits;
  limits.seconds = kPatience;
  const std::vector<std::string> trial{
      program.string(), "--unshare-all", "--ro-bind",         "/",   "/", "--proc", "/proc",
      "--dev",          "/dev",          "--die-with-parent", "true"};
  return RunCommand(trial, directory.path(), Wall(), limits).status == 0;
}

}  // namespace

const fs::path& Bubblewrap() {
  static const fs::path found = [] {
    const fs::path program = FindProgram("bwrap");
    return program.is_absolute() && fs::exists(program) && Works(program) ? program : fs::path();
  }();
  return found;
}

std::vector<std::string> InBubble(const std::vector<std::string>& command,
                                  const std::vector<fs::path>& system,
                                  const std::vector<fs::path>& readable, const fs::path& own) {
  // nothing of the machine is shared: processes, network and temporary files are its own
  std::vector<std::string> words{Bubblewrap().string(),
                                 "--unshare-all",
                                 "--die-with-parent",
                                 "--proc",
                                 "/proc",
                                 "--dev",
                                 "/dev",
                                 "--tmpfs",
                                 "/tmp"};
  const auto bind = [&words](const char* how, const fs::path& path) {
    words.insert(words.end(), {how, path.string(), path.string()});
  };
  // the system and what the command needs to be read, its own directory to be written
  for (const fs::path& path : system) bind("--ro-bind-try", path);
  for (const fs::path& path : readable) bind("--ro-bind-try", path);
  bind("--bind", own);
  words.insert(words.end(), {"--chdir", own.string(), "--"});
  words.insert(words.end(), command.begin(), command.end());
  return words;
}

}  // namespace warmjoint::inline tools
