#include <fmt/ranges.h>
#include <warmjoint/attach.h>

#include <algorithm>
#include <map>

#include "models/foundation/atomic_file.h"
#include "models/foundation/excerpt.h"
#include "sim/model/effort_limit.h"
#include "sim/model/friction_actuator.h"
#include "sim/model/joint_pattern.h"
#include "sim/model/light_joints.h"
#include "sim/model/load_model.h"
#include "sim/model/save_model.h"
#include "sim/model/spec_elements.h"
#include "sim/plugin/friction_reports.h"
#include "sim/plugin/plugin_instances.h"

namespace warmjoint::inline sim {
namespace {

namespace fs = std::filesystem;

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
        servos.push_back(mjs_getString(mjs_getName(element)));
      }
    }
  }
  if (!servos.empty()) {
    notices.push_back(fmt::format("{}: --armature changes their kv, which follows from dampratio",
                                  fmt::join(servos, ", ")));
  }
  if (options.integrator) spec.option.integrator = *options.integrator;
  if (!options.timestep) return;
  if (!(std::isfinite(*options.timestep) && *options.timestep > 0)) {
    Refuse({"--timestep"}, "is {}; it must be above 0, s", *options.timestep);
  }
  spec.option.timestep = *options.timestep;
}

/// Takes away what the friction replaces and what would clip it. Returns notices.
std::vector<std::string> MakeRoom(mjSpec& spec, const std::vector<FrictionForJoint>& frictions,
                                  FrictionForm form, const Place& place) {
  // the joints' own damping and dry friction
  std::vector<std::string> joints, replaced, notices;
  for (const FrictionForJoint& friction : frictions) {
    joints.push_back(friction.joint);
    if (ClearOwnFriction(*FindJoint(spec, friction.joint, place))) {
      replaced.push_back(friction.joint);
    }
  }
  if (!replaced.empty()) {
    notices.push_back(fmt::format(
        "{}: damping and frictionloss of the model were removed; the friction replaces them",
        fmt::join(replaced, ", ")));
  }

  // passive forces are not clipped by limits on actuators
  if (form == FrictionForm::passive) return notices;
  for (std::string& notice : MoveEffortLimits(spec, joints, place)) {
    notices.push_back(std::move(notice));
  }
  return notices;
}

/// Refuses joints on which friction acts before any is attached.
void RefuseSecond(const mjModel* m, const std::vector<FrictionForJoint>& frictions,
                  // the plugin itself, since it compares all of its instances
                  const Place& place) {
  int plugin = -1;
  mjp_getPlugin(kFrictionPlugin, &plugin);
  for (const FrictionForJoint& friction : frictions) {
    const int joint = mj_name2id(m, mjOBJ_JOINT, friction.joint.c_str());
    const std::string other = FrictionOn(m, joint, plugin, static_cast<int>(m->nplugin));
    if (other.empty()) continue;
    Refuse(place, "joint '{}' has friction already, by {}; remove one of the two",
           Excerpt(friction.joint), other);
  }
}

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

}  // namespace

Attached AttachFriction(const fs::path& model, const std::vector<FrictionForJoint>& frictions,
                        const fs::path& out, const AttachOptions& options) {
  // the model, with a friction for each joint that is meant
  const Place place{model.string()};
  for (const auto& [name, folder] : options.packages) {
    if (fs::is_directory(folder)) continue;
    Refuse({"--package"}, "of '{}' is '{}', which is not a folder", Excerpt(name),
           Excerpt(folder.string()));
  }
  ParsedModel parsed = ParseModel(model, options.packages);
  mjSpec& spec = *parsed.spec;
  const std::vector<FrictionForJoint> each = Expand(spec, frictions, place);
  NoteNameless(spec, frictions, parsed.notices);

  // what changes of it besides friction
  Change(spec, options, place, parsed.notices);
  for (std::string& notice : MakeRoom(spec, each, options.form, place)) {
    parsed.notices.push_back(std::move(notice));
  }

  // what cannot carry its friction is told with its remedy before the plugin sees it
  CheckJoints(spec, each, place);
  const ModelPtr before = CompileModel(spec, place);
  RefuseSecond(before.get(), each, place);
  RefuseLightJoints(before.get(), each, place);
  for (std::string& notice : NoticesOfHolding(before.get(), each)) {
    parsed.notices.push_back(std::move(notice));
  }
  AddFriction(spec, each, place, options.form);
  CompileModel(spec, place);

  // the result must load from where it will lie
  if (HasFiles(spec)) {
    PointTo(spec.compiler.meshdir, FolderOf(model), FolderOf(out));
    PointTo(spec.compiler.texturedir, FolderOf(model), FolderOf(out));
  }
  AtomicFile file(out);
  file.Write(ModelToXml(spec, place));
  LoadModel(file.temporary());
  file.Commit();

  Attached attached{{}, std::move(parsed.notices)};
  for (const FrictionForJoint& friction : each) attached.joints.push_back(friction.joint);
  return attached;
}

}  // namespace warmjoint::inline sim
