// Friction onto the joints of any robot.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/model/friction_actuator.h"

namespace warmjoint::inline sim {

/// Reads an MJCF or URDF model and writes it to `out` as MJCF, with the plugin on the given joints:
/// - the joint's own damping and frictionloss, which the friction replaces, are removed;
/// - an effort limit of the joint (actuatorfrcrange, effort in URDF), which would clip friction
///   too, becomes the force range of its motors, of a new motor where it has none;
/// - everything else stays, in MuJoCo's own writing: six significant digits, includes and defaults
///   resolved; meshes and textures are still found in the folder of the original.
/// Returns the notices of reading and of the first two, one sentence each.
/// Throws BadInput for a model that does not load, an unknown joint (with the nearest name), a
/// joint that is neither hinge nor slide or has friction already, and what the plugin refuses
/// (for example an inertia too small for the friction at the model's step); then `out` is not
/// written.
std::vector<std::string> AttachFriction(const std::filesystem::path& model,
                                        const std::vector<FrictionForJoint>& frictions,
                                        const std::filesystem::path& out);

}  // namespace warmjoint::inline sim
