#include "tools/store/run_description.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "models/foundation/excerpt.h"
#include "scenarios/yaml.h"

namespace warmjoint {
namespace {

/// Values of a YAML document by their dotted paths.
using ScalarsByPath = std::map<std::string, std::string>;

void Flatten(const Tree& tree, const std::string& path, ScalarsByPath& scalars) {
  const std::string prefix = path.empty() ? "" : path + ".";
  if (!tree.is_structured()) scalars[path] = tree.is_null() ? "nothing" : tree.get<std::string>();
  for (const auto& [name, value] : tree.items()) {
    if (tree.is_structured()) Flatten(value, prefix + name, scalars);
  }
}

ScalarsByPath ScalarsOf(const std::string& yaml, const char* what) {
  ScalarsByPath scalars;
  Flatten(ParseYaml(yaml, what).tree(), "", scalars);
  return scalars;
}

std::string ValueOrNothing(const ScalarsByPath& scalars, const std::string& path) {
  const auto found = scalars.find(path);
  return found == scalars.end() ? "nothing" : found->second;
}

/// What differs, one "path: old in the directory, new asked" each.
std::vector<std::string> Differences(const ScalarsByPath& before, const ScalarsByPath& after) {
  // paths of either suite, since both may lack some
  ScalarsByPath paths = before;
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

}  // namespace

void RefuseDifferentRun(const RunDescription& stored, const RunDescription& asked,
                        const Place& place) {
  // results of other versions do not mix; the versions asked for are this program's own
  if (stored.versions != asked.versions) {
    std::string made;
    for (const auto& [name, value] : stored.versions) made += fmt::format(" {} {}", name, value);
    Refuse(place, "was made with{}, which does not mix with this; run in another directory", made);
  }
  ScalarsByPath before;
  try {
    before = ScalarsOf(stored.suite_yaml, "the stored suite");
  } catch (const BadInput& unreadable) {
    Refuse(place, "holds no suite that can be read ({})", unreadable.what());
  }
  const ScalarsByPath after = ScalarsOf(asked.suite_yaml, "the suite");
  std::vector<std::string> differences = Differences(before, after);
  if (differences.empty()) return;

  // another name says more than all that differs
  const std::string old_name = ValueOrNothing(before, "name");
  const std::string new_name = ValueOrNothing(after, "name");
  if (old_name != new_name) {
    Refuse(place, "was made by suite {}, and this is {}; choose another directory",
           Excerpt(old_name), Excerpt(new_name));
  }
  // two differences say enough
  const size_t shown = std::min<size_t>(differences.size(), 2);
  const std::string more =
      differences.size() > shown ? fmt::format("; and {} more", differences.size() - shown) : "";
  differences.resize(shown);
  Refuse(place, "holds another run ({}{}); resume it as it was started or choose another directory",
         fmt::join(differences, "; "), more);
}

}  // namespace warmjoint
