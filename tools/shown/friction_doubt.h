// How well an estimate's friction is known, as compensation takes it.
#pragma once

#include <warmjoint/estimate.h>

#include "models/friction/compensator.h"

namespace warmjoint::shown {

/// level_std: root mean square of the deviations of the cold friction_at_speeds. heat_std: the larger deviation of the heat that
/// sliding at their median speed has made within a time constant, and in the end, by the covariance. noise: the fit's
/// rmse. 0 for what the estimate does not say.
FrictionDoubt DoubtOf(const Estimate& estimate);

}  // namespace warmjoint::shown
