// One changed entry of a scenario.
#pragma once

#include <string>
#include <vector>

namespace warmjoint {

/// A `--set key=value` of the command line or of a suite's ladder. key: a dotted path such as
/// noise.torque; value: YAML, where `null` takes the entry out.
struct Setting {
  std::string key;
  std::string value;
};

using Settings = std::vector<Setting>;

}  // namespace warmjoint
