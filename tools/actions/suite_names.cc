#include "tools/actions/suite_names.h"

#include <algorithm>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/robots/robot_folder.h"

namespace warmjoint {
namespace fs = std::filesystem;
namespace {

constexpr const char* kExtension = ".yaml";

fs::path SuiteFolder() { return DataFolder() / "scenarios" / "suites"; }

}  // namespace

std::vector<std::string> SuiteNames() {
  // an installation without suites has none
  std::vector<std::string> names;
  if (!fs::is_directory(SuiteFolder())) return names;
  for (const auto& entry : fs::directory_iterator(SuiteFolder())) {
    if (entry.path().extension() == kExtension) names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

fs::path SuiteFile(const std::string& name) { return SuiteFolder() / (name + kExtension); }

std::string FindSuite(const std::string& name_or_path) {
  // a file goes before a name
  std::error_code unknown;
  const fs::path path = name_or_path;
  if (fs::exists(path, unknown) && !fs::is_directory(path, unknown)) return name_or_path;

  // a name has neither a folder nor an extension
  const std::vector<std::string> names = SuiteNames();
  const bool is_name = !path.has_extension() && !path.has_parent_path();
  if (is_name && std::find(names.begin(), names.end(), name_or_path) != names.end()) {
    return SuiteFile(name_or_path);
  }
  const std::string stem = path.stem();
  Refuse({name_or_path}, "is neither a file nor a shipped suite{}", Suggestion(stem, names));
}

}  // namespace warmjoint
