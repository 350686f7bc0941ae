// energy-map: friction over position, velocity and energy.
#pragma once

#include "identification/identifier.h"

namespace warmjoint::inline identification {

/// The paper's expansion over P x V x E (40 x 6 x 3 kernels), once E is known from a fit of law,
/// position map and warming together (warm_maps.h).
Identifier EnergyMap();

}  // namespace warmjoint::inline identification
