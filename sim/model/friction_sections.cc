#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "models/foundation/serialize.h"
#include "models/foundation/xml_tags.h"
#include "models/friction/friction_json.h"
#include "models/friction/joint_friction.h"
#include "models/friction/parameter_rows.h"
#include "models/friction/thermal.h"
#include "sim/model/friction_actuator.h"
#include "sim/plugin/register.h"

namespace warmjoint {
namespace {

using nlohmann::json;

std::string Config(const std::string& key, const std::string& value) {
  return fmt::format("      <config key=\"{}\" value=\"{}\"/>\n", key, EscapeXml(value));
}

/// The shortest text that reads back as the same number.
std::string Config(const std::string& key, double value) {
  return Config(key, fmt::format("{}", value));
}

/// One number, or a list of two.
json EnergyToJson(const std::vector<double>& energy) {
  return energy.size() == 1 ? json(energy.front()) : json(energy);
}

std::string ThermalConfigs(std::string_view prefix, const std::optional<Thermal>& thermal) {
  if (!thermal) return "";
  return Config(fmt::format("{}{}", prefix, kGainName), thermal->gain) +
         Config(fmt::format("{}{}", prefix, kTimeConstantName), thermal->time_constant);
}

std::string InlineConfigs(const FrictionForJoint& of) {
  const Friction& friction = of.friction;
  // the law and its warming
  std::string configs = Config("law", friction.law);
  for (const auto& [key, value] : friction.parameters) configs += Config(key, value);
  configs += ThermalConfigs("", friction.thermal);
  configs += ThermalConfigs(kSecondStage, friction.second_thermal);

  // what joins any law, where it is given
  for (const FrictionOption& option : FrictionOptions()) {
    const double value = friction.*option.value;
    if (value != 0) configs += Config(std::string(option.info.name), value);
  }
  if (friction.gear != 1) configs += Config("gear", friction.gear);

  // maps and the first heat
  if (!friction.maps.empty()) {
    configs += Config("maps", WriteValue(friction.maps).dump());
  }
  if (!of.initial_energy.empty()) {
    configs += Config("initial_energy", EnergyToJson(of.initial_energy).dump());
  }
  return configs;
}

/// What is the same for all joints of an instance.
std::string OptionConfigs(const AttachOptions& options, Viscous viscous) {
  std::string configs;
  if (viscous == Viscous::by_damping) configs += Config("viscous_as_damping", "true");
  if (options.stiffest_drive != 0) configs += Config("stiffest_drive", options.stiffest_drive);
  return configs;
}

}  // namespace

std::string FrictionActuatorOf(const std::string& joint) { return joint + "_friction"; }

std::string FrictionSections(const FrictionForJoint& friction, const AttachOptions& options,
                             Viscous viscous) {
  return fmt::format(R"(  <extension>
    <plugin plugin="{}"/>
  </extension>
  <actuator>
    <plugin name="{}" joint="{}" plugin="{}" actdim="{}">
{}    </plugin>
  </actuator>
)",
                     kFrictionPlugin, EscapeXml(FrictionActuatorOf(friction.joint)),
                     EscapeXml(friction.joint), kFrictionPlugin, StateOf(friction.friction).size(),
                     InlineConfigs(friction) + OptionConfigs(options, viscous));
}

std::string InstanceSection(const std::string& instance,
                            const std::vector<FrictionForJoint>& frictions,
                            const AttachOptions& options, Viscous viscous) {
  // friction and first heat of each joint, by its name
  json joints = json::object(), energies = json::object();
  for (const FrictionForJoint& friction : frictions) {
    joints[friction.joint] = FrictionToTree(friction.friction);
    if (friction.initial_energy.empty()) continue;
    energies[friction.joint] = EnergyToJson(friction.initial_energy);
  }
  std::string configs = Config("instance", instance) + Config("joints", joints.dump());
  if (!energies.empty()) configs += Config("initial_energy", energies.dump());
  if (options.sensors) configs += Config("joint_sensors", "true");
  configs += OptionConfigs(options, viscous);
  return fmt::format(R"(  <extension>
    <plugin plugin="{}">
      <instance name="{}">
{}      </instance>
    </plugin>
  </extension>
)",
                     kFrictionPlugin, EscapeXml(instance), configs);
}

std::string MinimalModel(const Friction& friction, JointKind kind) {
  CheckFriction(friction, {});
  // heavy enough for any slope at this step
  constexpr double kTimestep = 0.001;  // s
  const auto slope = PlaceOf(LawPart::slope, *FindLaw(friction.law));
  const double needed = slope ? 10 * kTimestep * LawValues(friction)[*slope] : 0;
  const double inertia = std::max(1.0, needed);
  const bool slides = kind == JointKind::linear;
  return fmt::format(R"(<mujoco model="friction">
  <!-- load the plugin first: mj_loadPluginLibrary("libwarmjoint_friction.so").
       In another model: the sections <extension> and <actuator>, with that model's joint. -->
  <option timestep="{}" integrator="implicitfast"/>
  <worldbody>
    <body name="link">
      <joint name="joint" type="{}" axis="{}"/>
      <inertial pos="0 0 0" mass="{}" diaginertia="{} {} {}"/>
      <geom type="box" size="0.2 0.05 0.05" mass="0" contype="0" conaffinity="0"/>
    </body>
  </worldbody>
{}</mujoco>
)",
                     kTimestep, slides ? "slide" : "hinge", slides ? "1 0 0" : "0 0 1", inertia,
                     inertia, inertia, inertia, FrictionSections({"joint", friction}));
}

}  // namespace warmjoint
