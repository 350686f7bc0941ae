#include <fmt/ranges.h>
#include <warmjoint/attach.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "models/foundation/atomic_file.h"
#include "models/foundation/excerpt.h"
#include "sim/model/friction_actuator.h"
#include "sim/model/load_model.h"
#include "sim/model/spec_elements.h"
#include "sim/plugin/plugin_instances.h"
#include "sim/plugin/register.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;

/// The folder of a file, also of one that is named without a folder.
fs::path FolderOf(const fs::path& file) {
  return fs::weakly_canonical(fs::absolute(file).parent_path());
}

/// Where assets lie, seen from the folder of the written model.
void PointTo(mjString* directory, const fs::path& from, const fs::path& to) {
  const fs::path absolute = fs::weakly_canonical(from / mjs_getString(directory));
  const fs::path relative = absolute.lexically_relative(to);
  mjs_setString(directory, relative.empty() ? absolute.c_str() : relative.c_str());
}

bool HasFiles(mjSpec& spec) {
  for (const mjtObj type : {mjOBJ_MESH, mjOBJ_HFIELD, mjOBJ_SKIN, mjOBJ_TEXTURE}) {
    if (mjs_firstElement(&spec, type)) return true;
  }
  return false;
}

/// Gives an actuator the range of its joint, in the actuator's own force, cut to what it had.
void LimitForce(mjsActuator& motor, const double range[2]) {
  // a negative gear turns the range round
  const double gear = motor.gear[0];
  const double lower = std::min(range[0] / gear, range[1] / gear);
  const double upper = std::max(range[0] / gear, range[1] / gear);

  // a range that the actuator had already stays, where it is narrower
  const bool limited =
      motor.forcelimited == mjLIMITED_TRUE ||
      (motor.forcelimited == mjLIMITED_AUTO && motor.forcerange[0] < motor.forcerange[1]);
  motor.forcerange[0] = limited ? std::max(motor.forcerange[0], lower) : lower;
  motor.forcerange[1] = limited ? std::min(motor.forcerange[1], upper) : upper;
  motor.forcelimited = mjLIMITED_TRUE;
}

bool Drives(const mjsActuator& motor, const std::string& joint) {
  const bool by_joint = motor.trntype == mjTRN_JOINT || motor.trntype == mjTRN_JOINTINPARENT;
  return by_joint && motor.gear[0] != 0 && mjs_getString(motor.target) == joint;
}

/// Number of actuators that took the joint's limit.
int LimitMotors(mjSpec& spec, const std::string& joint, const double range[2]) {
  int motors = 0;
  for (mjsElement* element : SpecElements(spec, mjOBJ_ACTUATOR)) {
    mjsActuator* motor = mjs_asActuator(element);
    if (!Drives(*motor, joint)) continue;
    LimitForce(*motor, range);
    ++motors;
  }
  return motors;
}

bool Limited(const mjsJoint& joint) {
  if (joint.actfrclimited != mjLIMITED_AUTO) return joint.actfrclimited == mjLIMITED_TRUE;
  return joint.actfrcrange[0] < joint.actfrcrange[1];
}

void Note(const std::vector<std::string>& joints, const char* sentence,
          std::vector<std::string>& notices) {
  if (joints.empty()) return;
  notices.push_back(fmt::format("{}: {}", fmt::join(joints, ", "), sentence));
}

/// One friction for each joint, in the order of the command; a joint that two of them mean is
/// refused.
std::vector<FrictionForJoint> Expand(mjSpec& spec, const std::vector<FrictionForJoint>& frictions,
                                     const Place& place) {
  // the pattern that gave each joint its friction, for those that two of them mean
  std::vector<FrictionForJoint> expanded;
  std::map<std::string, std::string> given;
  for (const FrictionForJoint& friction : frictions) {
    for (const std::string& joint : MatchJoints(spec, friction.joint, place)) {
      const auto [before, added] = given.emplace(joint, friction.joint);
      if (!added) {
        Refuse(place, "joint '{}' is given friction twice, by '{}' and by '{}'; give it one",
               Excerpt(joint), Excerpt(before->second), Excerpt(friction.joint));
      }
      expanded.push_back(friction);
      expanded.back().joint = joint;
    }
  }
  return expanded;
}

/// Tells of joints that a pattern passed over, since they have no name.
void NoteNameless(mjSpec& spec, const std::vector<FrictionForJoint>& frictions,
                  std::vector<std::string>& notices) {
  const int nameless = NamelessJoints(spec);
  const auto is_pattern = [&](const FrictionForJoint& friction) {
    return !mjs_findElement(&spec, mjOBJ_JOINT, friction.joint.c_str());
  };
  if (nameless == 0 || std::none_of(frictions.begin(), frictions.end(), is_pattern)) return;
  notices.push_back(fmt::format(
      "{} of the model's hinges and slides have no name and so no friction; name them to give it",
      nameless));
}

/// Armatures, integrator and step as the options have them.
void Change(mjSpec& spec, const AttachOptions& options, const Place& place,
            std::vector<std::string>& notices) {
  std::vector<std::string> servos;
  for (const auto& [pattern, value] : options.armatures) {
    if (!std::isfinite(value) || value < 0) {
      Refuse({"--armature"}, "of '{}' is {}; it must be a number of 0 or more, kg.m^2 or kg",
             Excerpt(pattern), value);
    }
    for (const std::string& joint : MatchJoints(spec, pattern, place)) {
      double& armature = FindJoint(spec, joint, place)->armature;
      if (armature == value) continue;
      armature = value;
      // a second bias above 0 is MuJoCo's sign of a damping ratio
      for (mjsElement* element : SpecElements(spec, mjOBJ_ACTUATOR)) {
        const mjsActuator& servo = *mjs_asActuator(element);
        const bool follows = servo.biastype == mjBIAS_AFFINE && servo.biasprm[2] > 0;
        if (!follows || mjs_getString(servo.target) != joint) continue;
        servos.push_back(NameOf(element));
      }
    }
  }
  Note(servos, "--armature changes their kv, which follows from dampratio", notices);
  if (options.integrator) spec.option.integrator = *options.integrator;
  if (!options.timestep) return;
  if (!(std::isfinite(*options.timestep) && *options.timestep > 0)) {
    Refuse({"--timestep"}, "is {}; it must be above 0, s", *options.timestep);
  }
  spec.option.timestep = *options.timestep;
}

/// Moves the effort limits (actuatorfrcrange, effort in URDF) of the named joints to the actuators
/// that drive them, cut to what these had: a joint's limit clips the sum of its actuators, and
/// would clip a friction that is one of them. A limit R of the joint is R / gear of an actuator.
/// Of a joint that no actuator drives by itself the limit is taken away, and nothing added.
/// Notes what was done, one sentence each.
void MoveEffortLimits(mjSpec& spec, const std::vector<std::string>& joints, const Place& place,
                      std::vector<std::string>& notices) {
  std::vector<std::string> moved, shared, dropped;
  // motors take the joint's limit over, so that it clips them and not friction
  for (const std::string& name : joints) {
    mjsJoint* joint = FindJoint(spec, name, place);
    if (!Limited(*joint)) continue;
    const int motors = LimitMotors(spec, name, joint->actfrcrange);
    if (motors == 0) {
      dropped.push_back(
          fmt::format("{} ({} to {})", name, joint->actfrcrange[0], joint->actfrcrange[1]));
    } else {
      (motors == 1 ? moved : shared).push_back(name);
    }
    joint->actfrclimited = mjLIMITED_FALSE;
  }
  Note(moved, "the joint's effort limit now limits its actuator alone; it would clip friction too",
       notices);
  Note(shared,
       "the joint's effort limit now limits each of its actuators by itself and no longer their "
       "sum; it would clip friction too",
       notices);
  Note(dropped,
       "the joint's effort limit was taken away, since it would clip friction and no actuator "
       "drives the joint; give this range to the actuator that you add, as its forcerange",
       notices);
}

/// Takes away what the friction replaces and what would clip it.
void MakeRoom(mjSpec& spec, const std::vector<FrictionForJoint>& frictions, FrictionForm form,
              const Place& place, std::vector<std::string>& notices) {
  // the joints' own damping and dry friction
  std::vector<std::string> joints, replaced;
  for (const FrictionForJoint& friction : frictions) {
    joints.push_back(friction.joint);
    if (ClearOwnFriction(*FindJoint(spec, friction.joint, place))) {
      replaced.push_back(friction.joint);
    }
  }
  Note(replaced, "damping and frictionloss of the model were removed; the friction replaces them",
       notices);
  // passive forces are not clipped by limits on actuators
  if (form == FrictionForm::actuator) MoveEffortLimits(spec, joints, place, notices);
}

/// Refuses joints on which friction acts before any is attached.
void RefuseSecond(const mjModel* m, const std::vector<FrictionForJoint>& frictions,
                  const Place& place) {
  int plugin = -1;
  mjp_getPlugin(kFrictionPlugin, &plugin);
  for (const FrictionForJoint& friction : frictions) {
    const int joint = mj_name2id(m, mjOBJ_JOINT, friction.joint.c_str());
    const std::string other =
        FrictionOn(m, joint, plugin, static_cast<int>(m->nactuator), static_cast<int>(m->nplugin));
    if (other.empty()) continue;
    Refuse(place, "joint '{}' has friction already, by {}; remove one of the two",
           Excerpt(friction.joint), other);
  }
}

}  // namespace

Attached AttachFriction(mjSpec& spec, const std::vector<FrictionForJoint>& frictions,
                        const AttachOptions& options, const std::string& name, const mjVFS* files) {
  // a friction for each joint that is meant
  const Place place{name};
  std::vector<FrictionForJoint> each = Expand(spec, frictions, place);
  Attached attached;
  NoteNameless(spec, frictions, attached.notices);

  // what changes of the model besides friction
  Change(spec, options, place, attached.notices);
  MakeRoom(spec, each, options.form, place, attached.notices);

  // what cannot carry its friction is told with its remedy before the plugin sees it
  CheckJoints(spec, each, place);
  const ModelPtr before = CompileModel(spec, place, files);
  RefuseSecond(before.get(), each, place);
  RefuseLightJoints(before.get(), each, place);
  std::ranges::move(NoticesOfHolding(before.get(), each), std::back_inserter(attached.notices));
  // an instance that acts by itself has its joints in the order of the model
  if (options.form == FrictionForm::passive) {
    std::ranges::sort(each, {}, [&](const FrictionForJoint& friction) {
      return mj_name2id(before.get(), mjOBJ_JOINT, friction.joint.c_str());
    });
  }
  AddFriction(spec, each, place, options);
  CompileModel(spec, place, files);
  for (const FrictionForJoint& friction : each) attached.joints.push_back(friction.joint);
  return attached;
}

Attached AttachFriction(const fs::path& model, const std::vector<FrictionForJoint>& frictions,
                        const fs::path& out, const AttachOptions& options) {
  // the model as it is written
  for (const auto& [name, folder] : options.packages) {
    if (fs::is_directory(folder)) continue;
    Refuse({"--package"}, "of '{}' is '{}', which is not a folder", Excerpt(name),
           Excerpt(folder.string()));
  }
  ParsedModel parsed = ParseModel(model, options.packages);
  mjSpec& spec = *parsed.spec;
  Attached attached = AttachFriction(spec, frictions, options, model.string());
  attached.notices.insert(attached.notices.begin(), parsed.notices.begin(), parsed.notices.end());

  // the result must load from where it will lie
  if (HasFiles(spec)) {
    PointTo(spec.compiler.meshdir, FolderOf(model), FolderOf(out));
    PointTo(spec.compiler.texturedir, FolderOf(model), FolderOf(out));
  }
  AtomicFile file(out);
  file.Write(ModelToXml(spec, {model.string()}));
  LoadModel(file.temporary());
  file.Commit();
  return attached;
}

}  // namespace warmjoint
