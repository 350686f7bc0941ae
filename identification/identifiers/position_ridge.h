// position-ridge: a nominal law and a map over the joint's position.
#pragma once

#include "identification/identifier.h"

namespace warmjoint::inline identification {

/// Eqs. (10)-(16): law and Gaussian kernels over position, one part for each direction of motion,
/// or over position times velocity.
Identifier PositionRidge();

}  // namespace warmjoint::inline identification
