// Warming where level and slope both follow the heat.
#pragma once

#include <warmjoint/friction.h>

#include "identification/identifier.h"

namespace warmjoint {

/// Gain and time constant of Eq. (27), F = Fn(v) + k sign(v) x + c v x, with x the measured losses
/// |tau v| filtered by 1 / (1 + s tau): linear in all but tau, which is searched for by golden
/// section within a factor of four to both sides of `start`. A fit without c would give k and tau a
/// part of it.
Thermal FitSlopeHeat(const IdentifierInput& input, const Law& law, const Thermal& start);

}  // namespace warmjoint
