#include "tools/store/run_description.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "scenarios/yaml_value.h"

namespace warmjoint::inline tools {
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
  // both suites as lists of paths with their values
  std::map<std::string, std::string> before, after;
  Flatten(YamlValue::Parse(stored, "the stored suite").node(), "", before);
  Flatten(YamlValue::Parse(asked, "the suite").node(), "", after);

  // paths of either suite, since both may lack some
  std::map<std::string, std::string> paths = before;
  paths.insert(after.begin(), after.end());
  std::vector<std::string> differences;
  for (const auto& [path, value] : paths) {
    // what only one of them has counts as nothing in the other
    const std::string old_value = ValueOrNothing(before, path);
    const std::string new_value = ValueOrNothing(after, path);
    if (old_value == new_value) continue;
    differences.push_back(
        fmt::format("{}: {} in the directory, {} asked", path, old_value, new_value));
  }
  return differences;
}

namespace {

void RefuseDifferentVersions(const RunDescription& stored, const RunDescription& asked,
                             const Place& place) {
  if (stored.versions == asked.versions) return;
  // the versions that are stored, since those asked for are this program's own
  std::string made;
  for (const auto& [name, value] : stored.versions) made += fmt::format(" {} {}", name, value);
  Refuse(place, "was made with{}, which does not mix with this; run in another directory", made);
}

/// Refuses a suite of another name, which says more than all that differs.
void RefuseDifferentSuite(const std::string& stored, const std::string& asked, const Place& place) {
  std::map<std::string, std::string> before, after;
  Flatten(YamlValue::Parse(stored, "the stored suite").node(), "", before);
  Flatten(YamlValue::Parse(asked, "the suite").node(), "", after);
  if (before["name"] == after["name"]) return;
  Refuse(place, "was made by suite {}, and this is {}; choose another directory",
         Excerpt(before["name"]), Excerpt(after["name"]));
}

}  // namespace

void RefuseDifferentRun(const RunDescription& stored, const RunDescription& asked,
                        const Place& place) {
  // results of other versions do not mix
  RefuseDifferentVersions(stored, asked, place);
  std::vector<std::string> differences;
  try {
    differences = SuiteDifferences(stored.suite_yaml, asked.suite_yaml);
  } catch (const BadInput& unreadable) {
    Refuse(place, "holds no suite that can be read ({})", unreadable.what());
  }
  if (differences.empty()) return;
  RefuseDifferentSuite(stored.suite_yaml, asked.suite_yaml, place);
  // two differences say enough
  const size_t shown = std::min<size_t>(differences.size(), 2);
  const std::string more =
      differences.size() > shown ? fmt::format("; and {} more", differences.size() - shown) : "";
  differences.resize(shown);
  Refuse(place, "holds another run ({}{}); resume it as it was started or choose another directory",
         fmt::join(differences, "; "), more);
}

}  // namespace warmjoint::inline tools
