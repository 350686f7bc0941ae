// Attributes of the plugin: one name=value a line.
#include "sim/plugin/attributes.h"

#include "models/friction/friction_json.h"
#include "tests/fuzz/fuzz.h"

void warmjoint::fuzz::Read(std::string_view bytes) {
  AttributeTexts given;
  while (!bytes.empty()) {
    const std::string_view line = fuzz::TakeLine(bytes);
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) continue;
    // files of the machine are not for fuzzing
    const std::string name(line.substr(0, equals));
    if (name == "file" || name == "folder") continue;
    if (equals + 1 < line.size()) given[name] = line.substr(equals + 1);
  }
  const Place place{"fuzz"};
  const DescribedJoints joints = DescribeJoints(given, place);
  fuzz::Require(!joints.empty());
  for (const auto& [name, joint] : joints) CheckFriction(joint.friction, place);
}
