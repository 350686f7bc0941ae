#include "sim/friction_actuator.h"

#include "models/foundation/bad_input.h"
#include "sim/plugin/friction_instance.h"

namespace warmjoint {
namespace {

std::string Config(const std::string& key, const std::string& value) {
  return fmt::format("      <config key=\"{}\" value=\"{}\"/>\n", key, value);
}

/// The shortest text that reads back as the same number.
std::string Config(const std::string& key, double value) {
  return Config(key, fmt::format("{}", value));
}

}  // namespace

std::string FrictionActuator(const std::string& name, const std::string& joint,
                             const FrictionDescription& friction) {
  std::string configs = Config("law", friction.law);
  for (const auto& [key, value] : friction.parameters) configs += Config(key, value);
  if (friction.thermal) {
    configs += Config("thermal_gain", friction.thermal->gain);
    configs += Config("thermal_time_constant", friction.thermal->time_constant);
  }
  if (friction.gear != 1) configs += Config("gear", friction.gear);
  return fmt::format(
      "  <actuator>\n    <plugin name=\"{}\" joint=\"{}\" plugin=\"{}\" actdim=\"{}\">\n{}"
      "    </plugin>\n  </actuator>\n",
      name, joint, kFrictionPlugin, kFrictionStates, configs);
}

std::string FrictionExtension() {
  return fmt::format("  <extension>\n    <plugin plugin=\"{}\"/>\n  </extension>\n",
                     kFrictionPlugin);
}

std::string WithSections(const std::string& model, const std::string& sections,
                         const std::string& path) {
  const size_t end = model.rfind("</mujoco>");
  if (end == std::string::npos) Refuse({path}, "has no </mujoco>; is it an MJCF model?");
  return model.substr(0, end) + sections + model.substr(end);
}

}  // namespace warmjoint
