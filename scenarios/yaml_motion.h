// The `motion` part of a scenario file.
#pragma once

#include <string>

#include "scenarios/motion.h"
#include "scenarios/yaml_value.h"

namespace warmjoint::inline scenarios {

/// Reads and checks a motion. Throws BadInput with file:line for no speeds, a speed that is not
/// positive, both or neither of hold and travel, phases beside other entries, and unknown entries.
Motion ReadMotion(const YamlValue& value);

/// The YAML of it, one entry a line, each line behind `indent`.
std::string MotionToYaml(const Motion& motion, const std::string& indent);

}  // namespace warmjoint::inline scenarios
