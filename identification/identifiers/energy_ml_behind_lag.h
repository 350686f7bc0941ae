// Identifier `energy-ml`: law and warming, and on demand the lag of the torque that shows them.
#pragma once

#include "identification/identifier.h"

namespace warmjoint::inline identification {

/// energy_ml.h, with the option `torque_lag`: where it asks for a lag and the log shows one, law and
/// warming are fitted once more behind it (lagged_warm_fit.h).
Identifier EnergyMlBehindLag();

}  // namespace warmjoint::inline identification
