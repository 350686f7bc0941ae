// The lag of the torque in a fit of law and heat.
#pragma once

#include "identification/warming/law_fit.h"

namespace warmjoint {

/// Fits once more with the lag of the torque that leaves the least squares (SearchLag), where the log shows a lag. Losses follow
/// from the friction itself, which no lag touches.
void AddTorqueLag(LawFit& law);

}  // namespace warmjoint
