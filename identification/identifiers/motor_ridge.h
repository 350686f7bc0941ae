// motor-ridge: a nominal law, a map over the joint's angle and one over the motor's.
#pragma once

#include "identification/identifier.h"

namespace warmjoint::inline identification {

/// Ripple repeats with the motor's turn: kernels over mod(gear p, 2 pi) x V on a circle, beside a
/// part over the joint's position for each direction of motion.
Identifier MotorRidge();

}  // namespace warmjoint::inline identification
