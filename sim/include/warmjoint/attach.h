// Friction in MuJoCo models. They need the plugin (libwarmjoint_friction.so) to load.
//
//   AttachFriction("robot.urdf", {{"elbow", ReadFriction("estimate.json")}}, "warm.xml", {.form = FrictionForm::passive});
#pragma once

#include <mujoco/mujoco.h>
#include <warmjoint/friction.h>

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace warmjoint {

/// How friction acts in a model.
enum class FrictionForm {
  /// An actuator for each joint: states in mjData.act, a control for the ambient.
  actuator,
  /// One instance of the plugin for all joints, to which a body refers: states in
  /// mjData.plugin_state; actuators, controls and keyframes of the model stay as they are.
  passive,
  /// MuJoCo's own joint springs with a yield (4.0), without the plugin: a driver that the program calls after each step sets their yields from the
  /// heat; without it the friction stays as warm as it began.
  native,
};

inline std::span<const Word<FrictionForm>> WordsOf(FrictionForm) {
  static constexpr std::array words{Word{"actuator", FrictionForm::actuator},
                                    Word{"passive", FrictionForm::passive},
                                    Word{"native", FrictionForm::native}};
  return words;
}

/// Who chooses the integrator where no one is given.
enum class IntegratorChoice {
  model,      // it stays
  automatic,  // implicitfast where servos are so stiff that joints would shake, and there alone
};

/// MuJoCo's integrators by their names in MJCF.
const std::map<std::string, mjtIntegrator>& Integrators();

/// Which kind of joint a friction is of by the units of its estimate's parameters, as {"coulomb", "N.m"}; nothing where
/// they do not tell.
std::optional<JointKind> KindOfUnits(const std::map<std::string, std::string>& units);

/// The folder of each ROS package by its name: package://NAME/FILE is FOLDER/FILE.
using PackageFolders = std::map<std::string, std::filesystem::path>;

/// An armature for the joints that a name or pattern means (MatchJoints).
struct ArmatureForJoints {
  std::string joints;
  double value = 0;  // kg.m^2 or kg; takes the place of the model's
};

/// What attaching changes of a model besides adding friction.
struct AttachOptions {
  FrictionForm form = FrictionForm::actuator;
  std::vector<ArmatureForJoints> armatures{};
  std::optional<mjtIntegrator> integrator{};
  IntegratorChoice integrator_choice = IntegratorChoice::model;
  std::optional<double> timestep{};                // s
  std::optional<std::array<double, 3>> gravity{};  // m/s^2; none: the model's
  PackageFolders packages{};                       // of a URDF's meshes
  /// A sensor "JOINT_friction" for each joint: force on it (N.m or N), heat E (N.m or N), rise of its
  /// temperature (K), loss (W), 1 held or 0 sliding.
  bool sensors = false;
  /// An array "INSTANCE/NUMBER" of the model for each number of the frictions, which may change at run
  /// time; an entry for each joint, 0 where its friction has no such number.
  bool numbers = false;
  /// Of a servo in a program's own code, which the model does not show: h^2 kp + 2 h kv over the joint's inertia, 0 to 3.
  double stiffest_drive = 0;
  /// In the native form, whether what springs cannot hold is left out or replaced, with a notice, and not refused.
  bool approximate = false;
  /// Which kind of joint a friction is of, where that is known: by its `joint` as given.
  std::map<std::string, JointKind> kinds{};
};

/// A joint spring with a yield that holds friction's level.
struct NativeSpring {
  FrictionForJoint friction;  // as the spring holds it
  double stiffness = 0;       // N.m/rad or N/m
  double yield = 0;           // with the heat at the start, rad or m
};

/// What was attached.
struct Attached {
  std::vector<std::string> joints;      // that carry the friction now, in the order of its instance
  std::vector<std::string> notices;     // of reading and of what was changed, one sentence each
  std::vector<NativeSpring> springs{};  // of the native form
};

/// Puts friction on joints of a model:
/// - `joint` of each friction is a name or a pattern (MatchJoints);
/// - the joint's own damping and frictionloss, the stiffness of a spring that yields (MuJoCo 4.0) and the damping of its
///   actuators, which the friction replaces, are removed; the joint's damping is the friction's constant viscous from then on, which MuJoCo adds;
/// - a pattern leaves joints of the other kind than its friction's out (AttachOptions.kinds);
/// - friction that the model has by an earlier call in the same form joins the new one's instance;
/// - as actuators: an effort limit of the joint, which would clip friction too, is moved
///   (MoveEffortLimits); in the passive form it stays;
/// - in the native form level, viscous and heat become joint springs, dampers and arrays that a driver reads (sim/model/native_springs.h);
/// - everything else compiles to the same bits as before.
/// name: of the model, in messages; files: meshes and textures that lie in memory.
/// Throws BadInput for a model that does not compile, a joint that is unknown (with the nearest name),
/// that two frictions name, that is neither hinge nor slide or has friction already, joints too
/// light for their friction (RefuseLightJoints), and what the plugin refuses; then the spec is half
/// changed.
Attached AttachFriction(mjSpec& spec, const std::vector<FrictionForJoint>& frictions,
                        const AttachOptions& options, const std::string& name,
                        const mjVFS* files = nullptr);

/// Reads an MJCF or URDF model and writes it to `out` as MJCF, with friction on the given joints, as
/// above; meshes and textures are still found in the folder of the original. Where it throws, `out` is
/// not written.
Attached AttachFriction(const std::filesystem::path& model,
                        const std::vector<FrictionForJoint>& frictions,
                        const std::filesystem::path& out, const AttachOptions& options = {});

/// A small model that runs, with the friction on its only joint, "joint": what an identified
/// friction looks like in MuJoCo, to try out or to copy from.
std::string MinimalModel(const Friction& friction, JointKind kind);

}  // namespace warmjoint
