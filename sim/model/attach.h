// Friction onto the joints of any robot.
#pragma once

#include <mujoco/mujoco.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "models/foundation/bad_input.h"
#include "sim/model/friction_actuator.h"
#include "sim/model/urdf_meshes.h"

namespace warmjoint::inline sim {

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
  std::optional<double> timestep{};  // s
  PackageFolders packages{};         // of a URDF's meshes
};

/// What was attached.
struct Attached {
  std::vector<std::string> joints;   // that carry the friction now
  std::vector<std::string> notices;  // of reading and of what was changed, one sentence each
};

/// Reads an MJCF or URDF model and writes it to `out` as MJCF, with friction on the given joints:
/// - `joint` of each friction is a name or a pattern (MatchJoints);
/// - the joint's own damping and frictionloss, which the friction replaces, are removed;
/// - as actuators: an effort limit of the joint, which would clip friction too, is moved
///   (MoveEffortLimits); in the passive form it stays;
/// - everything else compiles to the same bits as before; meshes and textures are still found in
///   the folder of the original.
/// Throws BadInput for a model that does not load, a joint that is unknown (with the nearest name),
/// that two frictions name, that is neither hinge nor slide or has friction already, joints too
/// light for their friction (RefuseLightJoints), and what the plugin refuses; then `out` is not
/// written.
Attached AttachFriction(const std::filesystem::path& model,
                        const std::vector<FrictionForJoint>& frictions,
                        const std::filesystem::path& out, const AttachOptions& options = {});

}  // namespace warmjoint::inline sim
