#include "sim/model/friction_actuator.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <nlohmann/json.hpp>

#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"
#include "sim/model/escape_xml.h"
#include "sim/model/mujoco_handles.h"
#include "sim/model/spec_elements.h"
#include "sim/plugin/friction_instance.h"
#include "sim/plugin/register.h"

namespace warmjoint::inline sim {
namespace {

std::string Config(const std::string& key, const std::string& value) {
  return fmt::format("      <config key=\"{}\" value=\"{}\"/>\n", key, value);
}

/// The shortest text that reads back as the same number.
std::string Config(const std::string& key, double value) {
  return Config(key, fmt::format("{}", value));
}

std::string ActuatorOf(const std::string& joint) { return joint + "_friction"; }

/// The sections <extension> and <actuator> of one plugin actuator.
std::string Sections(const std::string& joint, size_t states, const std::string& configs) {
  return fmt::format(R"(  <extension>
    <plugin plugin="{}"/>
  </extension>
  <actuator>
    <plugin name="{}" joint="{}" plugin="{}" actdim="{}">
{}    </plugin>
  </actuator>
)",
                     kFrictionPlugin, EscapeXml(ActuatorOf(joint)), EscapeXml(joint),
                     kFrictionPlugin, states, configs);
}

/// The sections <extension> and <actuator> of a plugin whose attribute `joints` holds them all.
std::string SharedSections(const std::vector<FrictionForJoint>& frictions) {
  nlohmann::json joints;
  for (const auto& [joint, friction] : frictions) joints[joint] = FrictionToJson(friction);
  return Sections(frictions.front().joint, StateOf(frictions.front().friction).size(),
                  Config("joints", EscapeXml(joints.dump())));
}

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
    Refuse(place, "joint '{}' has friction already, by actuator '{}'; remove one of the two",
           Excerpt(joint), mjs_getString(mjs_getName(element)));
  }
}

void AddActuator(mjSpec& spec, const std::string& joint, int states) {
  mjsActuator* actuator = mjs_addActuator(&spec, nullptr);
  mjs_setName(actuator->element, ActuatorOf(joint).c_str());
  mjs_setString(actuator->target, joint.c_str());
  actuator->trntype = mjTRN_JOINT;
  actuator->actdim = states;
  actuator->plugin.active = 1;
  mjs_setString(actuator->plugin.plugin_name, kFrictionPlugin);
}

/// A name that no plugin instance of the model has: friction, friction_2, ...
std::string FreeInstanceName(mjSpec& spec) {
  std::string name = "friction";
  for (int i = 2; mjs_findElement(&spec, mjOBJ_PLUGIN, name.c_str()); ++i) {
    name = fmt::format("friction_{}", i);
  }
  return name;
}

/// The plugin instance that holds the attributes: those of one joint by themselves, of several as
/// one JSON object.
mjsPlugin* AddInstance(mjSpec& spec, const std::vector<FrictionForJoint>& frictions,
                       const Place& place) {
  RegisterFrictionPlugin();
  mjs_activatePlugin(&spec, kFrictionPlugin);
  mjsPlugin* instance = mjs_addPlugin(&spec);
  instance->active = 1;
  mjs_setString(instance->plugin_name, kFrictionPlugin);
  const bool several = frictions.size() > 1;
  const SpecPtr source =
      ParseSections(several ? SharedSections(frictions)
                            : FrictionSections(frictions.front().joint, frictions.front().friction),
                    place);
  const mjsActuator* written = mjs_asActuator(mjs_firstElement(source.get(), mjOBJ_ACTUATOR));
  mjs_setPluginAttributes(instance, const_cast<void*>(mjs_getPluginAttributes(&written->plugin)));
  if (several) {
    // as the element's name it is found, as the instance's it is written
    const std::string name = FreeInstanceName(spec);
    mjs_setName(instance->element, name.c_str());
    mjs_setString(instance->name, name.c_str());
  }
  return instance;
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
  return Sections(joint, StateOf(friction).size(), configs);
}

mjsJoint* FindJoint(mjSpec& spec, const std::string& joint, const Place& place) {
  mjsElement* found = mjs_findElement(&spec, mjOBJ_JOINT, joint.c_str());
  if (found) return mjs_asJoint(found);
  Refuse(place, "there is no joint '{}'{}", Excerpt(joint),
         Suggestion(joint, SpecNames(spec, mjOBJ_JOINT)));
}

void AddFriction(mjSpec& spec, const std::vector<FrictionForJoint>& frictions, const Place& place) {
  if (frictions.empty()) return;
  for (const auto& [joint, friction] : frictions) {
    CheckFriction(friction, place);
    const mjsJoint* target = FindJoint(spec, joint, place);
    if (target->type != mjJNT_HINGE && target->type != mjJNT_SLIDE) {
      Refuse(place, "joint '{}' is neither hinge nor slide; friction acts on these alone",
             Excerpt(joint));
    }
    RefuseSecond(spec, joint, place);
    AddActuator(spec, joint, static_cast<int>(StateOf(friction).size()));
  }

  // one instance holds the attributes
  mjsPlugin* instance = AddInstance(spec, frictions, place);
  for (const auto& [joint, friction] : frictions) {
    mjsElement* actuator = mjs_findElement(&spec, mjOBJ_ACTUATOR, ActuatorOf(joint).c_str());
    mjsPlugin& plugin = mjs_asActuator(actuator)->plugin;
    plugin.element = instance->element;
    mjs_setString(plugin.name, mjs_getString(instance->name));
  }
}

bool ClearOwnFriction(mjsJoint& joint) {
  const bool damped = std::any_of(std::begin(joint.damping), std::end(joint.damping),
                                  [](double coefficient) { return coefficient != 0; });
  const bool any = damped || joint.frictionloss != 0;
  std::fill(std::begin(joint.damping), std::end(joint.damping), 0.0);
  joint.frictionloss = 0;
  return any;
}

}  // namespace warmjoint::inline sim
