// From estimated parameters to a friction that can be used, within physical bounds.
#pragma once

#include "identification/estimate.h"
#include "models/friction/law.h"
#include "models/recording/measurements.h"

namespace warmjoint::inline identification {

/// Puts the law and the parameter values that `estimate` holds into estimate.friction.
/// Where a value lies outside of the bounds of the law's table there is no such friction, and it is
/// left out. A 95 % interval that lies outside as a whole shows that the law is the wrong one: the
/// estimate becomes void, inadequate_model. One that reaches the bound leaves that to chance, and
/// so does a value without an interval: the status stays, and a warning names value, bound and
/// remedy. `static` below `coulomb` is inadequate_model too.
void DescribeFriction(const Law& law, const Measurements& measurements, Estimate& estimate);

}  // namespace warmjoint::inline identification
