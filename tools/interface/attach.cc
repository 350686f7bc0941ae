#include <warmjoint/attach.h>

#include "models/foundation/atomic_file.h"
#include "models/friction/friction_json.h"
#include "models/robots/robot_folder.h"
#include "sim/model/friction_sections.h"
#include "tools/actions/attach_settings.h"
#include "tools/actions/outputs.h"
#include "tools/interface/convert_friction.h"
#include "tools/interface/convert_recording.h"
#include "tools/interface/guarded.h"

namespace warmjoint::api {

namespace {

models::FrictionDescription ForMuJoCo(const Friction& friction) {
  models::FrictionDescription made = ToDescription(friction);
  models::RefuseAmperes(made, {"friction"});
  return made;
}

}  // namespace

std::string MinimalModel(const Friction& friction, JointKind joint) {
  return Guarded([&] { return sim::MinimalModel(ForMuJoCo(friction), ToKind(joint)); });
}

void WriteMinimalModel(const Friction& friction, JointKind joint,
                       const std::filesystem::path& file) {
  Guarded([&] { models::WriteWholeFile(file, MinimalModel(friction, joint)); });
}

JointFriction ReadJointFriction(const std::string& joint, const std::filesystem::path& file,
                                const std::string& initial) {
  return Guarded([&] {
    // the first warning is what the estimate's own verdict says
    std::vector<std::string> warnings;
    const sim::FrictionForJoint read = tools::ReadFrictionForJoint(joint, file, initial, warnings);
    return JointFriction{read.joint, FromDescription(read.friction), read.initial_energy,
                         warnings.empty() ? "" : warnings.front()};
  });
}

Attached Attach(const std::filesystem::path& model, const std::vector<JointFriction>& frictions,
                const std::filesystem::path& out, const AttachSettings& settings) {
  return Guarded([&] {
    // settings and paths are checked as those of the command line are
    const sim::AttachOptions options =
        tools::CheckedOptions({settings.form, settings.armatures, settings.integrator,
                               settings.timestep, settings.packages});
    const std::filesystem::path file = models::FindRobot(model, "model");
    tools::KeepApart({out}, {file});

    // each friction is checked as it is converted
    std::vector<sim::FrictionForJoint> given;
    for (const JointFriction& one : frictions) {
      given.push_back({one.joint, ForMuJoCo(one.friction), one.initial_energy});
    }
    const sim::Attached done = sim::AttachFriction(file, given, out, options);
    return Attached{done.joints, done.notices};
  });
}

}  // namespace warmjoint::api
