#include "sim/model/earlier_friction.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "sim/model/friction_actuator.h"
#include "sim/model/spec_elements.h"
#include "sim/plugin/plugin_instances.h"
#include "sim/plugin/register.h"

namespace warmjoint {
namespace {

/// An instance as attach writes it: of the same form, each joint by its name in the model, its actuators by theirs.
bool IsOurs(const mjModel* m, int instance, FrictionForm form,
            const std::vector<ActingJoint>& joints) {
  const bool passive = !DrivenByActuators(m, instance);
  if (passive != (form == FrictionForm::passive)) return false;
  const auto prepared = PrepareInstance(m, instance);
  const bool inline_one = prepared->joints.contains("");
  if (!prepared->options.viscous_as_damping || (inline_one && joints.size() != 1)) return false;
  return std::ranges::all_of(joints, [&](const ActingJoint& joint) {
    const std::string name = NameIn(m, mjOBJ_JOINT, joint.joint);
    const bool named = inline_one || prepared->joints.contains(name);
    return named &&
           (passive || NameIn(m, mjOBJ_ACTUATOR, joint.actuator) == FrictionActuatorOf(name));
  });
}

/// One joint's friction as it was given, with the viscous that is the joint's damping.
FrictionForJoint Describe(mjSpec& spec, const mjModel* m, const ActingJoint& joint) {
  FrictionForJoint friction{NameIn(m, mjOBJ_JOINT, joint.joint), joint.prepared->description};
  Friction& of = friction.friction;
  const double damping = FindJoint(spec, friction.joint, {})->damping[0];
  if (of.parameters.contains(kViscousName)) of.parameters[kViscousName] = damping;
  const auto& [first, second] = joint.prepared->initial_energy;
  if (first == 0 && second == 0) return friction;
  friction.initial_energy = {first};
  if (of.second_thermal) friction.initial_energy.push_back(second);
  return friction;
}

/// Elements of a kind for which `goes` is true.
template <typename Goes>
std::vector<mjsElement*> Those(mjSpec& spec, mjtObj type, const Goes& goes) {
  std::vector<mjsElement*> elements = SpecElements(spec, type);
  std::erase_if(elements, [&](mjsElement* element) { return !goes(element); });
  return elements;
}

/// Lets a body refer to no instance, as the world. In a copied spec its words are those of the instance, which goes away, and MuJoCo's Python
/// counts the references to the element.
void ReferToNone(mjSpec& spec, mjsPlugin& plugin) {
  const mjsPlugin& none = mjs_findBody(&spec, "world")->plugin;
  plugin.active = 0;
  plugin.element = nullptr;
  plugin.plugin_name = none.plugin_name;
  plugin.name = none.name;
}

/// Takes the instances, and all that refers to them, out of the spec; whether they had arrays. names: theirs, without the nameless; refers:
/// whether an actuator or what else holds a plugin refers to one.
template <typename Refers>
bool Remove(mjSpec& spec, const std::vector<mjsElement*>& instances,
            const std::vector<std::string>& names, const Refers& refers) {
  std::vector<mjsElement*> gone = Those(spec, mjOBJ_SENSOR, [&](mjsElement* element) {
    return refers(mjs_asSensor(element)->plugin);
  });
  const std::vector<mjsElement*> actuators = Those(spec, mjOBJ_ACTUATOR, [&](mjsElement* element) {
    return refers(mjs_asActuator(element)->plugin);
  });
  const std::vector<mjsElement*> arrays = Those(spec, mjOBJ_NUMERIC, [&](mjsElement* element) {
    return std::ranges::any_of(
        names, [&](const std::string& name) { return NameOf(element).starts_with(name + "/"); });
  });
  gone.insert(gone.end(), actuators.begin(), actuators.end());
  gone.insert(gone.end(), arrays.begin(), arrays.end());
  for (mjsElement* element : SpecElements(spec, mjOBJ_BODY)) {
    mjsPlugin& plugin = mjs_asBody(element)->plugin;
    if (refers(plugin)) ReferToNone(spec, plugin);
  }
  for (mjsElement* element : gone) mjs_delete(&spec, element);
  // MuJoCo takes an instance away with the last element that refers to it
  for (mjsElement* instance : instances) {
    const std::vector<mjsElement*> left = SpecElements(spec, mjOBJ_PLUGIN);
    if (std::ranges::find(left, instance) != left.end()) mjs_delete(&spec, instance);
  }
  return !arrays.empty();
}

/// Takes an instance of that name, empty for one inline that acts on the joint, out of the spec; whether it had arrays.
bool RemoveOne(mjSpec& spec, const std::string& name, const std::string& joint) {
  mjsElement* instance = nullptr;
  if (!name.empty()) {
    instance = mjs_findElement(&spec, mjOBJ_PLUGIN, name.c_str());
  } else {
    mjsElement* element = mjs_findElement(&spec, mjOBJ_ACTUATOR, FrictionActuatorOf(joint).c_str());
    instance = mjs_asActuator(element)->plugin.element;
  }
  const auto refers = [&](const mjsPlugin& plugin) {
    if (!plugin.active) return false;
    return name.empty() ? plugin.element == instance : name == mjs_getString(plugin.name);
  };
  const std::vector<std::string> names =
      name.empty() ? std::vector<std::string>() : std::vector{name};
  return Remove(spec, {instance}, names, refers);
}

}  // namespace

std::vector<FrictionForJoint> TakeEarlier(mjSpec& spec, const mjModel* m, AttachOptions& options) {
  int plugin = -1;
  mjp_getPlugin(kFrictionPlugin, &plugin);
  std::vector<FrictionForJoint> earlier;
  for (int instance = 0; instance < m->nplugin; ++instance) {
    if (m->plugin[instance] != plugin) continue;
    const std::vector<ActingJoint> joints = FindJoints(m, instance);
    if (!IsOurs(m, instance, options.form, joints)) continue;
    // its joints in their order
    std::vector<FrictionForJoint> own;
    for (const ActingJoint& joint : joints) own.push_back(Describe(spec, m, joint));
    const bool arrays = RemoveOne(spec, NameIn(m, mjOBJ_PLUGIN, instance), own.front().joint);
    earlier.insert(earlier.end(), own.begin(), own.end());

    const InstanceOptions before = PrepareInstance(m, instance)->options;
    options.sensors = options.sensors || before.joint_sensors;
    options.numbers = options.numbers || arrays;
    options.stiffest_drive = std::max(options.stiffest_drive, before.stiffest_drive);
  }
  return earlier;
}

void RemoveFriction(mjSpec& spec) {
  const std::vector<mjsElement*> instances = Those(spec, mjOBJ_PLUGIN, [](mjsElement* element) {
    return mjs_getString(mjs_asPlugin(element)->plugin_name) == std::string_view(kFrictionPlugin);
  });
  std::vector<std::string> names;
  for (mjsElement* instance : instances) {
    const std::string name = NameOf(instance);
    if (!name.empty()) names.push_back(name);
  }
  Remove(spec, instances, names, [&](const mjsPlugin& plugin) {
    return plugin.active &&
           (mjs_getString(plugin.plugin_name) == std::string_view(kFrictionPlugin) ||
            std::ranges::find(names, mjs_getString(plugin.name)) != names.end());
  });
}

}  // namespace warmjoint
