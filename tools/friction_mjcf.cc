#include "tools/friction_mjcf.h"

#include <fmt/format.h>

namespace warmjoint {
namespace {

std::string Config(std::string_view key, const std::string& value) {
  return fmt::format("      <config key=\"{}\" value=\"{}\"/>\n", key, value);
}

/// The <config> lines of the plugin, numbers that read back bit for bit.
std::string Configs(const FrictionDescription& friction) {
  std::string lines = Config("law", friction.law);
  for (const auto& [name, value] : friction.parameters) {
    lines += Config(name, fmt::format("{}", value));
  }
  if (friction.thermal) {
    lines += Config(Thermal::parameters[0].name, fmt::format("{}", friction.thermal->gain));
    lines +=
        Config(Thermal::parameters[1].name, fmt::format("{}", friction.thermal->time_constant));
  }
  if (friction.gear != 1) lines += Config("gear", fmt::format("{}", friction.gear));
  return lines;
}

}  // namespace

std::string FrictionToMjcf(const FrictionDescription& friction, JointKind joint) {
  const char* type = joint == JointKind::linear ? "slide" : "hinge";
  return fmt::format(R"(<mujoco model="joint with identified friction">
  <extension>
    <plugin plugin="warmjoint.friction"/>
  </extension>
  <option timestep="0.001" integrator="implicitfast"/>
  <worldbody>
    <body>
      <joint name="joint" type="{}" axis="0 0 1"/>
      <geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.04" mass="3"/>
    </body>
  </worldbody>
  <actuator>
    <plugin name="friction of joint" joint="joint" plugin="warmjoint.friction" actdim="2">
{}    </plugin>
  </actuator>
</mujoco>
)",
                     type, Configs(friction));
}

}  // namespace warmjoint
