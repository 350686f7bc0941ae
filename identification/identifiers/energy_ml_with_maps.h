// Identifier `energy-ml` of the list: law and warming, and on demand maps beside them.
#pragma once

#include "identification/identifier.h"

namespace warmjoint::inline identification {

/// energy_ml_behind_lag.h, with the option `position`: where it names maps over the joint's or the motor's angle,
/// these are fitted together with law and warming (maps/energy_ml_maps.h), but behind no lag of the
/// torque.
Identifier EnergyMlWithMaps();

}  // namespace warmjoint::inline identification
