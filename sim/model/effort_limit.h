// Effort limits of joints that carry friction as an actuator.
#pragma once

#include <mujoco/mujoco.h>

#include <string>
#include <vector>

#include "models/foundation/bad_input.h"

namespace warmjoint::inline sim {

/// Moves the effort limits (actuatorfrcrange, effort in URDF) of the named joints to the actuators
/// that drive them, cut to what these had: a joint's limit clips the sum of its actuators, and
/// would clip a friction that is one of them. A limit R of the joint is R / gear of an actuator.
/// Of a joint that no actuator drives by itself the limit is taken away, and nothing added.
/// Returns what was done, one sentence each.
std::vector<std::string> MoveEffortLimits(mjSpec& spec, const std::vector<std::string>& joints,
                                          const Place& place);

}  // namespace warmjoint::inline sim
