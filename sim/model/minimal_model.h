// Friction as a MuJoCo model.
#pragma once

#include <string>

#include "models/friction/friction_description.h"

namespace warmjoint::inline sim {

/// A small model that runs, with the friction on its only joint, "joint": what an identified
/// friction looks like in MuJoCo, to try out or to copy from.
std::string MinimalModel(const FrictionDescription& friction, JointKind kind);

}  // namespace warmjoint::inline sim
