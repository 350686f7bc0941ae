#include "sim/single_joint_model.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "models/foundation/bad_input.h"
#include "models/foundation/nearest_name.h"
#include "sim/friction_actuator.h"
#include "sim/load_model.h"
#include "sim/plugin/check_actuator.h"
#include "sim/spec_elements.h"

namespace warmjoint {
namespace {

mjsJoint* FindJoint(mjSpec* spec, const std::string& joint, const std::string& path,
                    const std::string& asked_by) {
  mjsElement* found = mjs_findElement(spec, mjOBJ_JOINT, joint.c_str());
  if (found) return mjs_asJoint(found);
  Refuse({asked_by}, "robot {} has no joint '{}'{}", path, joint,
         Suggestion(joint, SpecNames(*spec, mjOBJ_JOINT)));
}

/// Removes all that acts on the robot, and every joint but one.
void KeepOnly(mjSpec* spec, mjsJoint* joint) {
  for (const mjtObj type : {mjOBJ_KEY, mjOBJ_SENSOR, mjOBJ_ACTUATOR, mjOBJ_EQUALITY, mjOBJ_TENDON,
                            mjOBJ_PAIR, mjOBJ_EXCLUDE}) {
    for (mjsElement* element : SpecElements(*spec, type)) mjs_delete(spec, element);
  }
  for (mjsElement* element : SpecElements(*spec, mjOBJ_JOINT)) {
    if (element != joint->element) mjs_delete(spec, element);
  }
}

void SetUp(mjSpec* spec, mjsJoint* joint, double timestep) {
  spec->compiler.fusestatic = 1;
  spec->option.timestep = timestep;
  spec->option.integrator = mjINT_EULER;
  spec->option.enableflags = 0;
  spec->option.disableflags = mjDSBL_CONSTRAINT | mjDSBL_CONTACT | mjDSBL_SENSOR | mjDSBL_EULERDAMP;
  std::fill(std::begin(joint->damping), std::end(joint->damping), 0.0);
  std::fill(std::begin(joint->stiffness), std::end(joint->stiffness), 0.0);
  joint->frictionloss = 0;
  joint->actfrclimited = mjLIMITED_FALSE;
}

/// The edited robot as MJCF text.
std::string SaveText(mjSpec* spec, const std::string& path) {
  CompileModel(*spec, {path});

  // the first call tells how much room the second needs
  char error[1000] = "";
  char nothing[1] = "";
  const int size = mj_saveXMLString(spec, nothing, sizeof(nothing), error, sizeof(error));
  if (size < 0) Refuse({path}, "cannot be written as MJCF: {}", error);
  std::string text(static_cast<size_t>(size) + 1, '\0');
  if (mj_saveXMLString(spec, text.data(), size + 1, error, sizeof(error)) != 0) {
    Refuse({path}, "cannot be written as MJCF: {}", error);
  }
  text.resize(text.find('\0'));
  return text;
}

ModelPtr CompileWithFriction(const std::string& text, const std::string& path) {
  char error[1000] = "";
  const SpecPtr spec(mj_parseXMLString(text.c_str(), nullptr, error, sizeof(error)));
  if (!spec) Refuse({path}, "does not load with friction: {}", error);
  mjs_setString(spec->modelfiledir, std::filesystem::path(path).parent_path().c_str());
  return CompileModel(*spec, {path});
}

}  // namespace

SingleJointModel LoadSingleJoint(const std::string& path, const std::string& joint,
                                 const FrictionDescription& friction, double timestep,
                                 const std::string& asked_by) {
  CheckFriction(friction, {asked_by});
  const ParsedModel parsed = ParseModel(path);
  const SpecPtr& spec = parsed.spec;
  mjsJoint* kept = FindJoint(spec.get(), joint, path, asked_by);
  KeepOnly(spec.get(), kept);
  SetUp(spec.get(), kept, timestep);

  // the plugin's attributes go in as text: the engine's interface for them is bound to its own C++
  // library
  const std::string sections =
      FrictionExtension() + FrictionActuator(joint + " friction", joint, friction);
  SingleJointModel result;
  result.model =
      CompileWithFriction(WithSections(SaveText(spec.get(), path), sections, path), path);

  const mjModel* m = result.model.get();
  result.kind = m->jnt_type[0] == mjJNT_SLIDE ? JointKind::linear : JointKind::rotary;
  result.limits = m->jnt_limited[0] ? std::pair(m->jnt_range[0], m->jnt_range[1])
                                    : std::pair(-kInfinity, kInfinity);
  result.inertia = EffectiveInertia(m, 0);
  result.friction_actuator = m->actuator_outadr[0];
  result.friction_state = m->actuator_actadr[0];
  return result;
}

}  // namespace warmjoint
