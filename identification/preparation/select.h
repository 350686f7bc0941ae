// Which samples obey Eq. (6): constant speed, so that torque = gravity + friction.
#pragma once

#include "models/recording/measurements.h"
#include "models/recording/selection.h"

namespace warmjoint::inline identification {

/// Keeps the samples that move at a constant speed; rests and accelerations are left out.
/// Works on plateaus of the velocity, so that a jump between two plateaus costs no sample.
Selection SelectConstantSpeed(const Measurements& measurements);

/// Keeps every sample with v != 0, for data that is known to satisfy Eq. (6) throughout.
Selection SelectMoving(const Measurements& measurements);

}  // namespace warmjoint::inline identification
