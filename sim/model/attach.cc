#include <fmt/ranges.h>
#include <warmjoint/attach.h>
#include <warmjoint/friction_model.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "models/foundation/atomic_file.h"
#include "models/foundation/excerpt.h"
#include "sim/model/attach_text.h"
#include "sim/model/earlier_friction.h"
#include "sim/model/friction_actuator.h"
#include "sim/model/load_model.h"
#include "sim/model/make_room.h"
#include "sim/model/native_springs.h"
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

JointKind KindOf(const mjsJoint& joint) {
  return joint.type == mjJNT_SLIDE ? JointKind::linear : JointKind::rotary;
}

std::string_view Called(JointKind kind) {
  return kind == JointKind::linear ? "slides (m, N)" : "hinges (rad, N.m)";
}

/// The joints that a name or pattern means, without those of another kind than its friction's. Of a pattern they are
/// left out with a notice; a name, or a pattern that means no other, is refused.
std::vector<std::string> MatchKind(mjSpec& spec, const std::string& pattern,
                                   const AttachOptions& options, const Place& place,
                                   std::vector<std::string>& notices) {
  std::vector<std::string> joints = MatchJoints(spec, pattern, place), others;
  const auto known = options.kinds.find(pattern);
  if (known == options.kinds.end()) return joints;
  const JointKind kind = known->second;
  std::erase_if(joints, [&](const std::string& joint) {
    const bool other = KindOf(*FindJoint(spec, joint, place)) != kind;
    if (other) others.push_back(joint);
    return other;
  });
  if (others.empty()) return joints;
  if (!joints.empty()) {
    notices.push_back(fmt::format("{}: left out; the friction of '{}' is of {}",
                                  fmt::join(others, ", "), pattern, Called(kind)));
    return joints;
  }
  const JointKind other = kind == JointKind::linear ? JointKind::rotary : JointKind::linear;
  Refuse(place, "{} of '{}' are {}, and its friction is of {}; give a friction of their kind",
         ExcerptOfList(others), Excerpt(pattern), Called(other), Called(kind));
}

/// One friction for each joint, in the order of the command; a joint that two of them mean is
/// refused.
std::vector<FrictionForJoint> Expand(mjSpec& spec, const std::vector<FrictionForJoint>& frictions,
                                     const AttachOptions& options, const Place& place,
                                     std::vector<std::string>& notices) {
  // the pattern that gave each joint its friction, for those that two of them mean
  std::vector<FrictionForJoint> expanded;
  std::map<std::string, std::string> given;
  for (const FrictionForJoint& friction : frictions) {
    for (const std::string& joint : MatchKind(spec, friction.joint, options, place, notices)) {
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

void CheckOptions(const AttachOptions& options) {
  const double drive = options.stiffest_drive;
  if (drive >= 0 && drive <= kStiffestDrive) return;
  Refuse({"--stiffest-drive"},
         "is {}; h^2 kp + 2 h kv over the inertia of your servo must be 0 to {}: take a shorter "
         "timestep or "
         "more armature",
         drive, kStiffestDrive);
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
  if (options.gravity) std::ranges::copy(*options.gravity, spec.option.gravity);
  if (!options.timestep) return;
  if (!(std::isfinite(*options.timestep) && *options.timestep > 0)) {
    Refuse({"--timestep"}, "is {}; it must be above 0, s", *options.timestep);
  }
  spec.option.timestep = *options.timestep;
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

const std::map<std::string, mjtIntegrator>& Integrators() {
  static const std::map<std::string, mjtIntegrator> integrators {
    {"Euler", mjINT_EULER}, {"RK4", mjINT_RK4}, {"implicit", mjINT_IMPLICIT},
        {"implicitfast", mjINT_IMPLICITFAST},
#if mjVERSION_HEADER >= 3017000
        {"discrete", mjINT_DISCRETE},
#endif
  };
  return integrators;
}

std::optional<JointKind> KindOfUnits(const std::map<std::string, std::string>& units) {
  for (const Law& law : Laws()) {
    for (const ParameterInfo& info : law.parameters) {
      const auto given = units.find(std::string(info.name));
      if (given == units.end() || info.unit.rotary == info.unit.linear) continue;
      if (given->second == info.unit.rotary) return JointKind::rotary;
      if (given->second == info.unit.linear) return JointKind::linear;
    }
  }
  return std::nullopt;
}

Attached AttachFriction(mjSpec& spec, const std::vector<FrictionForJoint>& frictions,
                        const AttachOptions& given, const std::string& name, const mjVFS* files) {
  // a friction for each joint that is meant
  const Place place{name};
  Attached attached;
  std::vector<std::string>& notices = attached.notices;
  std::vector<FrictionForJoint> each = Expand(spec, frictions, given, place, notices);
  NoteNameless(spec, frictions, notices);
  CheckJoints(spec, each, place);
  for (const FrictionForJoint& friction : each) attached.joints.push_back(friction.joint);

  // what changes of the model besides friction
  AttachOptions options = given;
  CheckOptions(options);
  Change(spec, options, place, notices);
  MakeRoom(spec, each, options.form, place, notices);

  // what cannot carry its friction is told with its remedy before the plugin sees it
  ModelPtr before = CompileModel(spec, place, files);
  if (options.integrator_choice == IntegratorChoice::automatic &&
      NeedsImplicitfast(before.get(), each)) {
    spec.option.integrator = mjINT_IMPLICITFAST;
    notices.emplace_back(
        "the integrator is implicitfast now; with the model's own its servos are too stiff for "
        "joints to come to rest");
    before = CompileModel(spec, place, files);
  }
  RefuseSecond(before.get(), each, place);
  // an instance that acts by itself, and springs, have their joints in the order of the model
  const auto sort = [&] {
    const auto place_of = [&](const std::string& joint) {
      return mj_name2id(before.get(), mjOBJ_JOINT, joint.c_str());
    };
    std::ranges::sort(each, {}, [&](const FrictionForJoint& one) { return place_of(one.joint); });
    std::ranges::sort(attached.joints, {}, place_of);
  };
  if (options.form == FrictionForm::native) {
    sort();
    std::ranges::move(NoticesOfOthers(before.get(), each), std::back_inserter(notices));
    attached.springs = AddSprings(spec, before.get(), each, options, place, notices);
    FinishSprings(spec, CompileModel(spec, place, files).get(), attached.springs);
    CompileModel(spec, place, files);
    return attached;
  }
  const std::vector<FrictionForJoint> earlier = TakeEarlier(spec, before.get(), options);
  each.insert(each.begin(), earlier.begin(), earlier.end());
  RefuseLightJoints(before.get(), each, place);
  std::ranges::move(NoticesOfHolding(before.get(), each, options.stiffest_drive),
                    std::back_inserter(notices));
  std::ranges::move(NoticesOfOthers(before.get(), each), std::back_inserter(notices));
  if (options.form == FrictionForm::passive) sort();
  AddFriction(spec, each, place, options, Viscous::by_damping);
  CompileModel(spec, place, files);
  return attached;
}

AttachedText AttachFrictionAsText(const fs::path& model,
                                  const std::vector<FrictionForJoint>& frictions,
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
  std::string xml = ModelToXml(spec, {model.string()});
  RequireLoads(xml, IsStandardOutput(out) ? fs::path("-") : out);
  return {std::move(attached), std::move(xml)};
}

Attached AttachFriction(const fs::path& model, const std::vector<FrictionForJoint>& frictions,
                        const fs::path& out, const AttachOptions& options) {
  AttachedText made = AttachFrictionAsText(model, frictions, out, options);
  WriteWholeFile(out, made.xml);
  return std::move(made.attached);
}

}  // namespace warmjoint
