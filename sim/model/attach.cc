#include "sim/model/attach.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "models/foundation/atomic_file.h"
#include "sim/model/load_model.h"
#include "sim/model/save_model.h"
#include "sim/model/spec_elements.h"

namespace warmjoint::inline sim {
namespace {

namespace fs = std::filesystem;

std::string NameOf(mjsElement* element) { return mjs_getString(mjs_getName(element)); }

/// Gives an actuator the range of its joint, cut to what it had.
void LimitForce(mjsActuator& motor, const double range[2]) {
  const bool limited =
      motor.forcelimited == mjLIMITED_TRUE ||
      (motor.forcelimited == mjLIMITED_AUTO && motor.forcerange[0] < motor.forcerange[1]);
  motor.forcerange[0] = limited ? std::max(motor.forcerange[0], range[0]) : range[0];
  motor.forcerange[1] = limited ? std::min(motor.forcerange[1], range[1]) : range[1];
  motor.forcelimited = mjLIMITED_TRUE;
}

void AddMotor(mjSpec& spec, const std::string& joint, const double range[2]) {
  mjsActuator* motor = mjs_addActuator(&spec, nullptr);
  const bool taken = mjs_findElement(&spec, mjOBJ_ACTUATOR, joint.c_str()) != nullptr;
  mjs_setToMotor(motor);
  mjs_setName(motor->element, (taken ? joint + "_motor" : joint).c_str());
  mjs_setString(motor->target, joint.c_str());
  motor->trntype = mjTRN_JOINT;
  LimitForce(*motor, range);
}

/// Moves a joint's effort limit to its motors. Returns whether it had one.
bool MoveEffortLimit(mjSpec& spec, mjsJoint& joint) {
  const bool limited =
      joint.actfrclimited == mjLIMITED_TRUE ||
      (joint.actfrclimited == mjLIMITED_AUTO && joint.actfrcrange[0] < joint.actfrcrange[1]);
  if (!limited) return false;
  const std::string name = NameOf(joint.element);
  bool driven = false;
  for (mjsElement* element : SpecElements(spec, mjOBJ_ACTUATOR)) {
    mjsActuator* motor = mjs_asActuator(element);
    if (motor->trntype != mjTRN_JOINT || mjs_getString(motor->target) != name) continue;
    LimitForce(*motor, joint.actfrcrange);
    driven = true;
  }
  if (!driven) AddMotor(spec, name, joint.actfrcrange);
  joint.actfrclimited = mjLIMITED_FALSE;
  return true;
}

/// Where assets lie, seen from the folder of the written model.
void PointTo(mjString* directory, const fs::path& from, const fs::path& to) {
  const fs::path absolute = fs::weakly_canonical(fs::absolute(from) / mjs_getString(directory));
  const fs::path relative = absolute.lexically_relative(fs::weakly_canonical(fs::absolute(to)));
  mjs_setString(directory, relative.empty() ? absolute.c_str() : relative.c_str());
}

bool HasFiles(mjSpec& spec) {
  for (const mjtObj type : {mjOBJ_MESH, mjOBJ_HFIELD, mjOBJ_SKIN, mjOBJ_TEXTURE}) {
    if (mjs_firstElement(&spec, type)) return true;
  }
  return false;
}

void Note(const std::vector<std::string>& joints, const std::string& sentence,
          std::vector<std::string>& notices) {
  if (joints.empty()) return;
  notices.push_back(fmt::format("{}: {}", fmt::join(joints, ", "), sentence));
}

}  // namespace

std::vector<std::string> AttachFriction(const fs::path& model,
                                        const std::vector<FrictionForJoint>& frictions,
                                        const fs::path& out) {
  const Place place{model.string()};
  ParsedModel parsed = ParseModel(model);
  mjSpec& spec = *parsed.spec;

  // what the friction replaces, and what would clip it
  std::vector<std::string> replaced, moved;
  for (const auto& [name, friction] : frictions) {
    mjsJoint* joint = FindJoint(spec, name, place);
    if (ClearOwnFriction(*joint)) replaced.push_back(name);
    if (MoveEffortLimit(spec, *joint)) moved.push_back(name);
  }
  Note(replaced, "damping and frictionloss of the model were removed; the friction replaces them",
       parsed.notices);
  Note(moved, "the joint's effort limit now limits its motor alone; it would clip friction too",
       parsed.notices);

  AddFriction(spec, frictions, place);
  CompileModel(spec, place);

  // the result must load from where it will lie
  const fs::path from = model.parent_path(), to = out.parent_path();
  if (HasFiles(spec)) {
    PointTo(spec.compiler.meshdir, from, to);
    PointTo(spec.compiler.texturedir, from, to);
  }
  AtomicFile file(out);
  WriteWholeFile(file.temporary(), ModelToXml(spec, place));
  LoadModel(file.temporary());
  file.Commit();
  return std::move(parsed.notices);
}

}  // namespace warmjoint::inline sim
