#include "tools/store/run_description.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <map>

namespace warmjoint {
namespace {

/// Every scalar below `node` by its dotted path.
void Flatten(const YAML::Node& node, const std::string& path,
             std::map<std::string, std::string>& scalars) {
  const std::string prefix = path.empty() ? "" : path + ".";
  if (node.IsMap()) {
    for (const auto& entry : node) {
      Flatten(entry.second, prefix + entry.first.as<std::string>(), scalars);
    }
  } else if (node.IsSequence()) {
    for (size_t i = 0; i < node.size(); ++i) Flatten(node[i], prefix + std::to_string(i), scalars);
  } else {
    scalars[path] = node.IsNull() ? "nothing" : node.as<std::string>();
  }
}

std::string ValueOrNothing(const std::map<std::string, std::string>& scalars,
                           const std::string& path) {
  const auto found = scalars.find(path);
  return found == scalars.end() ? "nothing" : found->second;
}

}  // namespace

std::vector<std::string> SuiteDifferences(const std::string& stored, const std::string& asked) {
  std::map<std::string, std::string> before, after;
  Flatten(YAML::Load(stored), "", before);
  Flatten(YAML::Load(asked), "", after);

  std::map<std::string, std::string> paths = before;
  paths.insert(after.begin(), after.end());
  std::vector<std::string> differences;
  for (const auto& [path, value] : paths) {
    const std::string old_value = ValueOrNothing(before, path);
    const std::string new_value = ValueOrNothing(after, path);
    if (old_value == new_value) continue;
    differences.push_back(
        fmt::format("{}: {} in the directory, {} asked", path, old_value, new_value));
  }
  return differences;
}

}  // namespace warmjoint
