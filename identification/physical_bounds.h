// Whether the values of a fit make a friction.
#pragma once

#include <vector>

#include "identification/fit.h"

namespace warmjoint {

/// Whether the value of a law parameter lies outside of its bounds, by chance or not.
bool LeavesBounds(const std::vector<FitParameter>& parameters);

/// Whether the level at rest is below that of sliding, of a law that has both.
bool RisesFromRest(const Friction& friction);

/// Whether the fit's friction may be used: nothing refuses it, its values lie inside of their physical
/// bounds, and its static level is not below its Coulomb level. That of Infer, without its covariance.
bool GivesFriction(const Fit& fit);

}  // namespace warmjoint
