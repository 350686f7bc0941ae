// Friction as a MuJoCo model.
#pragma once

#include <string>

#include "models/friction/friction_description.h"

namespace warmjoint {

/// A model that runs: one joint with the plugin warmjoint.friction, every attribute written out,
/// to be tried in `simulate` or copied from. friction: checked.
std::string FrictionToMjcf(const FrictionDescription& friction, JointKind joint);

}  // namespace warmjoint
