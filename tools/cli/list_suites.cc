#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "models/robots/robot_folder.h"
#include "scenarios/suite.h"
#include "tools/cli/families.h"

namespace warmjoint::inline tools {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// Entries of a folder of the project in the order of their names.
std::vector<fs::path> Entries(const fs::path& folder) {
  std::vector<fs::path> entries;
  if (!fs::is_directory(folder)) return entries;
  for (const auto& entry : fs::directory_iterator(folder)) entries.push_back(entry.path());
  std::sort(entries.begin(), entries.end());
  return entries;
}

}  // namespace

ordered_json SuitesJson() {
  ordered_json suites = ordered_json::array();
  for (const fs::path& file : Entries(DataFolder() / "scenarios/suites")) {
    if (file.extension() != ".yaml") continue;
    const Suite suite = ReadSuite(file);
    suites.push_back({{"name", suite.name},
                      {"question", suite.question},
                      {"realizations", suite.realizations},
                      {"file", file.string()}});
  }
  return suites;
}

std::string SuitesText() {
  std::string text;
  for (const ordered_json& suite : SuitesJson()) {
    text += fmt::format("{}  {} realizations  {}\n    {}\n", suite["name"].get<std::string>(),
                        suite["realizations"].get<int>(), suite["file"].get<std::string>(),
                        suite["question"].get<std::string>());
  }
  return text;
}

}  // namespace warmjoint::inline tools
