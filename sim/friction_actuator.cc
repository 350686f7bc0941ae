#include "sim/friction_actuator.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <nlohmann/json.hpp>

#include "models/foundation/nearest_name.h"
#include "sim/escape_xml.h"
#include "sim/mujoco_handles.h"
#include "sim/plugin/friction_instance.h"
#include "sim/plugin/register.h"
#include "sim/spec_elements.h"

namespace warmjoint {
namespace {

std::string Config(const std::string& key, const std::string& value) {
  return fmt::format("      <config key=\"{}\" value=\"{}\"/>\n", key, value);
}

/// The shortest text that reads back as the same number.
std::string Config(const std::string& key, double value) {
  return Config(key, fmt::format("{}", value));
}

std::string ActuatorOf(const std::string& joint) { return joint + "_friction"; }

/// A model of the sections alone. MuJoCo's map of attributes belongs to the C++ library that it was
/// built with; made here from text, it is only passed on.
SpecPtr ParseSections(const std::string& sections, const Place& place) {
  std::array<char, 1000> error{};
  const std::string text = "<mujoco>\n" + sections + "</mujoco>\n";
  SpecPtr spec(mj_parseXMLString(text.c_str(), nullptr, error.data(), error.size()));
  if (!spec) Refuse(place, "the friction cannot be written as MJCF: {}", error.data());
  return spec;
}

void RefuseSecond(mjSpec& spec, const std::string& joint, const Place& place) {
  for (mjsElement* element : SpecElements(spec, mjOBJ_ACTUATOR)) {
    const mjsActuator* actuator = mjs_asActuator(element);
    if (mjs_getString(actuator->target) != joint ||
        mjs_getString(actuator->plugin.plugin_name) != std::string_view(kFrictionPlugin)) {
      continue;
    }
    Refuse(place, "joint '{}' has friction already, by actuator '{}'; remove one of the two", joint,
           mjs_getString(mjs_getName(element)));
  }
}

}  // namespace

std::string FrictionSections(const std::string& joint, const FrictionDescription& friction) {
  std::string configs = Config("law", friction.law);
  for (const auto& [key, value] : friction.parameters) configs += Config(key, value);
  if (friction.thermal) {
    configs += Config("thermal_gain", friction.thermal->gain);
    configs += Config("thermal_time_constant", friction.thermal->time_constant);
  }
  if (friction.second_thermal) {
    configs += Config("second_thermal_gain", friction.second_thermal->gain);
    configs += Config("second_thermal_time_constant", friction.second_thermal->time_constant);
  }
  for (const FrictionOption& option : FrictionOptions()) {
    const double value = friction.*option.value;
    if (value != 0) configs += Config(std::string(option.info.name), value);
  }
  if (friction.gear != 1) configs += Config("gear", friction.gear);
  if (!friction.maps.empty()) {
    nlohmann::json maps = nlohmann::json::array();
    for (const FrictionMap& map : friction.maps) maps.push_back(MapToJson(map));
    configs += Config("maps", EscapeXml(maps.dump()));
  }
  return fmt::format(R"(  <extension>
    <plugin plugin="{}"/>
  </extension>
  <actuator>
    <plugin name="{}" joint="{}" plugin="{}" actdim="{}">
{}    </plugin>
  </actuator>
)",
                     kFrictionPlugin, EscapeXml(ActuatorOf(joint)), EscapeXml(joint),
                     kFrictionPlugin, StateOf(friction).size(), configs);
}

mjsJoint* FindJoint(mjSpec& spec, const std::string& joint, const Place& place) {
  mjsElement* found = mjs_findElement(&spec, mjOBJ_JOINT, joint.c_str());
  if (found) return mjs_asJoint(found);
  Refuse(place, "there is no joint '{}'{}", joint, Suggestion(joint, SpecNames(spec, mjOBJ_JOINT)));
}

void AddFriction(mjSpec& spec, const std::string& joint, const FrictionDescription& friction,
                 const Place& place) {
  CheckFriction(friction, place);
  const mjsJoint* target = FindJoint(spec, joint, place);
  if (target->type != mjJNT_HINGE && target->type != mjJNT_SLIDE) {
    Refuse(place, "joint '{}' is neither hinge nor slide; friction acts on these alone", joint);
  }
  RefuseSecond(spec, joint, place);

  RegisterFrictionPlugin();
  mjs_activatePlugin(&spec, kFrictionPlugin);
  mjsActuator* actuator = mjs_addActuator(&spec, nullptr);
  mjs_setName(actuator->element, ActuatorOf(joint).c_str());
  mjs_setString(actuator->target, joint.c_str());
  actuator->trntype = mjTRN_JOINT;
  actuator->actdim = static_cast<int>(StateOf(friction).size());

  // an instance of its own holds the attributes
  const SpecPtr source = ParseSections(FrictionSections(joint, friction), place);
  const mjsActuator* written = mjs_asActuator(mjs_firstElement(source.get(), mjOBJ_ACTUATOR));
  mjsPlugin* instance = mjs_addPlugin(&spec);
  instance->active = 1;
  mjs_setString(instance->plugin_name, kFrictionPlugin);
  mjs_setPluginAttributes(instance, const_cast<void*>(mjs_getPluginAttributes(&written->plugin)));
  actuator->plugin.active = 1;
  actuator->plugin.element = instance->element;
  mjs_setString(actuator->plugin.plugin_name, kFrictionPlugin);
}

bool ClearOwnFriction(mjsJoint& joint) {
  const bool damped = std::any_of(std::begin(joint.damping), std::end(joint.damping),
                                  [](double coefficient) { return coefficient != 0; });
  const bool any = damped || joint.frictionloss != 0;
  std::fill(std::begin(joint.damping), std::end(joint.damping), 0.0);
  joint.frictionloss = 0;
  return any;
}

}  // namespace warmjoint
