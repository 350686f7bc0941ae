#include "models/foundation/data_folder.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"

namespace warmjoint {
namespace fs = std::filesystem;

namespace {

constexpr std::string_view kLibraryMark = "library:";

}  // namespace

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

std::vector<std::string> MachineNames() {
  std::vector<std::string> names;
  const fs::path library = DataFolder() / "models" / "library";
  if (!fs::is_directory(library)) return names;
  for (const auto& entry : fs::directory_iterator(library)) {
    if (fs::exists(entry.path() / "card.json")) names.push_back(entry.path().filename());
  }
  std::ranges::sort(names);
  return names;
}

bool IsOfLibrary(const fs::path& path) { return path.native().starts_with(kLibraryMark); }

LibraryFriction FindInLibrary(const fs::path& path) {
  const std::string name = path.native().substr(kLibraryMark.size());
  const std::size_t slash = name.find('/');
  const std::string machine = name.substr(0, slash);
  const std::vector<std::string> machines = MachineNames();
  if (std::ranges::find(machines, machine) == machines.end()) {
    Refuse({Excerpt(path.native())}, "there is no machine '{}' in the library{}", Excerpt(machine),
           Suggestion(machine, machines));
  }
  return {DataFolder() / "models" / "library" / machine / "robot.json",
          slash == std::string::npos ? "" : name.substr(slash + 1)};
}

}  // namespace warmjoint
