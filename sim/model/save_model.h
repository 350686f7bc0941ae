// Models as MJCF text.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

#include "models/foundation/bad_input.h"

namespace warmjoint::inline sim {

/// A spec as MJCF text, as it was written and not as it was compiled (savecompiled and
/// savecanonical off): classes, frames, degrees, Euler angles and actuator shortcuts stay, and every
/// number has the digits that it needs to be read back to the same bits. MuJoCo's other notation
/// rounds to six digits. The text compiles to the model that the spec compiles to, bit for bit.
/// Throws BadInput from `place` where MuJoCo cannot write it.
std::string ModelToXml(mjSpec& spec, const Place& place);

}  // namespace warmjoint::inline sim
