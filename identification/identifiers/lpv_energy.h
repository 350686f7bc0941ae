// lpv-energy: a law whose parameters follow the energy.
#pragma once

#include "identification/identifier.h"

namespace warmjoint::inline identification {

/// F = kv(E) v + kc(E) sign(v), Eq. (27), linear parameter-varying in E: kv(E) and kc(E) are the
/// law's own values, E in kc, and kernels over E on both. E comes from energy-ml.
Identifier LpvEnergy();

}  // namespace warmjoint::inline identification
