// Friction in MuJoCo models: what `warmjoint attach` and `warmjoint identify --mjcf` do. The models need the plugin
// (libwarmjoint_friction.so) to load.
//
//   WriteMinimalModel(*estimate.friction, JointKind::rotary, "friction.xml");
//   Attach("robot.urdf", {ReadJointFriction("elbow", "estimate.json")}, "warm.xml", {.form = "passive"});
#pragma once

#include <warmjoint/estimate.h>

namespace warmjoint::api {

/// A small model that runs, with the friction on its only joint, "joint": MJCF. Throws BadInput where CheckFriction does.
std::string MinimalModel(const Friction& friction, JointKind joint = JointKind::rotary);

/// Writes it as a whole. Throws BadInput and OutputFailed.
void WriteMinimalModel(const Friction& friction, JointKind joint,
                       const std::filesystem::path& file);

/// Friction for some of a model's joints.
struct JointFriction {
  std::string joint;  // a name, or a regular expression
  Friction friction{};
  std::vector<double> initial_energy{};  // E1, and E2 of a second stage, N.m or N; empty: cold
  std::string warning{};  // what the estimate's own verdict says against its friction
};

/// The friction in an estimate.json or another friction file. initial: heat at the start, "cold", "end" (of the estimate's
/// recording) or "settled:SPEED" (rad/s or m/s). Throws BadInput, also for an estimate that holds no friction.
JointFriction ReadJointFriction(const std::string& joint, const std::filesystem::path& file,
                                const std::string& initial = "cold");

/// What attaching changes besides adding friction; members are called as options of the command line.
struct AttachSettings {
  std::string form = "actuator";  // --as: actuator or passive
  std::vector<std::pair<std::string, double>>
      armatures{};           // of a name or pattern: kg.m^2 or kg, at least 0
  std::string integrator{};  // Euler, RK4, implicit, implicitfast or discrete; empty: the model's
  std::optional<double> timestep{};  // s, above 0; the model's where not given
  std::vector<std::pair<std::string, std::string>>
      packages{};  // name and folder, of package:// in a URDF
};

/// What was attached.
struct Attached {
  std::vector<std::string> joints{};   // that carry the friction now
  std::vector<std::string> notices{};  // of reading and of what was changed, one sentence each
};

/// Reads an MJCF or URDF model, or one of the project's robots by its name, and writes it to `out` as MJCF with friction on
/// the given joints. Throws BadInput for models, joints, frictions and settings that cannot be used, and where `out` is
/// the model itself; then `out` is not written.
Attached Attach(const std::filesystem::path& model, const std::vector<JointFriction>& frictions,
                const std::filesystem::path& out, const AttachSettings& settings = {});

}  // namespace warmjoint::api
