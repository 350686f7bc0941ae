#include "sim/model/friction_actuator.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>

#include "models/foundation/excerpt.h"
#include "models/friction/check_friction.h"
#include "models/friction/joint_friction.h"
#include "sim/model/spec_elements.h"
#include "sim/plugin/register.h"

namespace warmjoint {
namespace {

/// A model of the section alone. MuJoCo's map of attributes belongs to the C++ library that it was
/// built with; made here from text, it is only passed on.
SpecPtr ParseSection(const std::string& section, const Place& place) {
  std::array<char, 1000> error{};
  const std::string text = "<mujoco>\n" + section + "</mujoco>\n";
  SpecPtr spec(mj_parseXMLString(text.c_str(), nullptr, error.data(), error.size()));
  if (!spec) Refuse(place, "the friction cannot be written as MJCF: {}", error.data());
  return spec;
}

/// A name that no plugin instance of the model has: friction, friction_2, ...
std::string FreeInstanceName(mjSpec& spec) {
  std::string name = "friction";
  for (int i = 2; mjs_findElement(&spec, mjOBJ_PLUGIN, name.c_str()); ++i) {
    name = fmt::format("friction_{}", i);
  }
  return name;
}

/// An instance of the plugin without a name and without attributes.
mjsPlugin* AddPlugin(mjSpec& spec) {
  RegisterFrictionPlugin();
  mjs_activatePlugin(&spec, kFrictionPlugin);
  mjsPlugin* instance = mjs_addPlugin(&spec);
  instance->active = 1;
  mjs_setString(instance->plugin_name, kFrictionPlugin);
  return instance;
}

void TakeAttributes(mjsPlugin& instance, const mjsPlugin& source) {
  mjs_setPluginAttributes(&instance, const_cast<void*>(mjs_getPluginAttributes(&source)));
}

/// The named instance that holds the friction of all joints.
mjsPlugin* AddInstance(mjSpec& spec, const std::vector<FrictionForJoint>& frictions,
                       const Place& place) {
  const std::string name = FreeInstanceName(spec);
  mjsPlugin* instance = AddPlugin(spec);
  const SpecPtr source = ParseSection(InstanceSection(name, frictions), place);
  TakeAttributes(*instance, *mjs_asPlugin(mjs_firstElement(source.get(), mjOBJ_PLUGIN)));
  // as the element's name it is found, as the instance's it is written
  mjs_setName(instance->element, name.c_str());
  mjs_setString(instance->name, name.c_str());
  return instance;
}

/// The nameless instance of one joint's actuator.
mjsPlugin* AddInlineInstance(mjSpec& spec, const FrictionForJoint& friction, const Place& place) {
  mjsPlugin* instance = AddPlugin(spec);
  const SpecPtr source = ParseSection(FrictionSections(friction), place);
  TakeAttributes(*instance, mjs_asActuator(mjs_firstElement(source.get(), mjOBJ_ACTUATOR))->plugin);
  return instance;
}

/// Makes an element refer to the instance.
void Refer(mjsPlugin& element, const mjsPlugin& instance) {
  element.active = 1;
  element.element = instance.element;
  mjs_setString(element.plugin_name, kFrictionPlugin);
  mjs_setString(element.name, mjs_getString(instance.name));
}

void AddActuator(mjSpec& spec, const FrictionForJoint& friction, const mjsPlugin& instance) {
  // made of MuJoCo's own defaults, and only then put under the model's
  const SpecPtr blank(mj_makeSpec());
  mjsActuator* actuator = mjs_addActuator(&spec, mjs_getSpecDefault(blank.get()));
  mjs_setDefault(actuator->element, mjs_getSpecDefault(&spec));
  mjs_setName(actuator->element, FrictionActuatorOf(friction.joint).c_str());
  mjs_setString(actuator->target, friction.joint.c_str());
  actuator->trntype = mjTRN_JOINT;
  actuator->actdim = static_cast<int>(StateOf(friction.friction).size());
  Refer(actuator->plugin, instance);
}

/// Lets the first body in the tree that moves by one of the joints, and is no other plugin's, refer
/// to the instance: MuJoCo leaves an instance that nothing refers to behind where a body is put into
/// another model.
void ReferFromBody(mjSpec& spec, const std::vector<FrictionForJoint>& frictions,
                   const mjsPlugin& instance) {
  std::set<std::string> names;
  for (const FrictionForJoint& friction : frictions) names.insert(friction.joint);
  for (mjsElement* element : SpecElements(spec, mjOBJ_JOINT)) {
    mjsBody* body = mjs_getParent(element);
    if (!names.contains(mjs_getString(mjs_getName(element))) || body->plugin.active) continue;
    return Refer(body->plugin, instance);
  }
}

}  // namespace

void CheckJoints(mjSpec& spec, const std::vector<FrictionForJoint>& frictions, const Place& place) {
  std::set<std::string> seen;
  for (const auto& [joint, friction, energy] : frictions) {
    CheckFriction(friction, place);
    const mjsJoint* target = FindJoint(spec, joint, place);
    if (target->type != mjJNT_HINGE && target->type != mjJNT_SLIDE) {
      Refuse(place, "joint '{}' is neither hinge nor slide; friction acts on these alone",
             Excerpt(joint));
    }
    if (!seen.insert(joint).second) {
      Refuse(place, "joint '{}' is given friction twice; give it one", Excerpt(joint));
    }
  }
}

void AddFriction(mjSpec& spec, const std::vector<FrictionForJoint>& frictions, const Place& place,
                 FrictionForm form) {
  if (frictions.empty()) return;
  CheckJoints(spec, frictions, place);
  const bool alone = form == FrictionForm::actuator && frictions.size() == 1;
  const mjsPlugin* instance = alone ? AddInlineInstance(spec, frictions.front(), place)
                                    : AddInstance(spec, frictions, place);
  if (form == FrictionForm::passive) return ReferFromBody(spec, frictions, *instance);
  for (const FrictionForJoint& friction : frictions) AddActuator(spec, friction, *instance);
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
