#include "models/robots/robot_folder.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"

namespace warmjoint {
namespace fs = std::filesystem;

fs::path DataFolder() {
  // the folder that is named, or else beside the program, or the build's default
  std::vector<fs::path> candidates;
  if (const char* named = std::getenv("WARMJOINT_DATA")) {
    candidates.emplace_back(named);
  } else {
    std::error_code unreadable;
    const fs::path program = fs::read_symlink("/proc/self/exe", unreadable);
    if (!unreadable) {
      candidates.push_back(program.parent_path().parent_path() / "share" / "warmjoint");
    }
    candidates.emplace_back(WARMJOINT_DATA_DEFAULT);
  }
  // the first that holds robots
  for (const fs::path& candidate : candidates) {
    if (fs::is_directory(candidate / "models" / "robots")) return candidate;
  }

  std::vector<std::string> places(candidates.begin(), candidates.end());
  Refuse({}, "models/robots was not found in {}; set WARMJOINT_DATA to its folder",
         fmt::join(places, " or "));
}

std::vector<std::string> RobotNames() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(DataFolder() / "models" / "robots")) {
    const std::string name = entry.path().filename();
    if (fs::exists((entry.path() / name).replace_extension(".xml"))) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

fs::path FindRobot(const std::string& name_or_path, const std::string& asked_by) {
  const bool is_path =
      name_or_path.find('/') != std::string::npos || fs::path(name_or_path).has_extension();
  // a file of the user's
  if (is_path) {
    if (fs::is_regular_file(name_or_path)) return name_or_path;
    Refuse({asked_by},
           "robot '{}' is neither a file nor a robot's name; give an MJCF or URDF file, or one of "
           "`warmjoint list robots`",
           name_or_path);
  }
  // a robot of the project, by its name
  const std::vector<std::string> names = RobotNames();
  if (std::find(names.begin(), names.end(), name_or_path) == names.end()) {
    Refuse({asked_by}, "there is no robot '{}'{}", Excerpt(name_or_path),
           Suggestion(name_or_path, names));
  }
  return DataFolder() / "models" / "robots" / name_or_path /
         fs::path(name_or_path).replace_extension(".xml");
}

}  // namespace warmjoint
