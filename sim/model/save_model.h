// Models as MJCF text.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

#include "models/foundation/bad_input.h"

namespace warmjoint::inline sim {

/// A compiled spec as MJCF text, as MuJoCo writes it (six significant digits). Throws BadInput from
/// `place` where MuJoCo cannot write it.
std::string ModelToXml(const mjSpec& spec, const Place& place);

}  // namespace warmjoint::inline sim
