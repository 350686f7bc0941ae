// Friction as MuJoCo's own joint springs with a yield, ready to be pasted into MJCF.
#pragma once

#include <string>
#include <vector>

#include "tools/export/engine_friction.h"

namespace warmjoint {

/// A joint element for each, with `stiffness`, `springyield` (rad, of angle="radian") and `damping`. timestep: of the model that it is for, s. Throws BadInput,
/// with what holds, for a joint whose inertia is not known, too little viscous beside the level, and a step too long.
std::string NativeText(const std::vector<EngineFriction>& frictions, double timestep);

}  // namespace warmjoint
