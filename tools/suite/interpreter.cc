#include "tools/suite/interpreter.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <mutex>
#include <string_view>

#include "tools/suite/run_command.h"
#include "tools/suite/working_directory.h"

namespace warmjoint::inline tools {
namespace fs = std::filesystem;
namespace {

constexpr double kPatience = 20;  // s, for a script that looks for an interpreter on a busy machine

/// python, python3, python3.12
bool IsPython(std::string_view word) {
  constexpr std::string_view name = "python";
  return word.starts_with(name) &&
         word.find_first_not_of("0123456789.", name.size()) == std::string_view::npos;
}

bool IsScript(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return stream.get() == '#' && stream.get() == '!';
}

/// What the script starts; the script itself where it does not tell.
fs::path Asked(const fs::path& script) {
  const WorkingDirectory directory;
  CommandLimits limits;
  limits.seconds = kPatience;
  const CommandEnd end = RunCommand({script, "-c", "import sys; print(sys.executable)"},
                                    directory.path(), Wall(), limits);
  const fs::path told = end.last_output;
  std::error_code ignored;
  const bool usable = end.status == 0 && told.is_absolute() && fs::is_regular_file(told, ignored);
  return usable ? told : script;
}

}  // namespace

fs::path FindInterpreter(const std::string& word) {
  const fs::path file = FindProgram(word);
  if (!IsPython(word) || !file.is_absolute() || !IsScript(file) || !WallHides(file, {})) {
    return file;
  }
  static std::mutex mutex;
  static std::map<fs::path, fs::path> known;
  const std::lock_guard lock(mutex);
  const auto found = known.find(file);
  return found != known.end() ? found->second : known.emplace(file, Asked(file)).first->second;
}

}  // namespace warmjoint::inline tools
