// Truth of the interface and of the rooms.
#pragma once

#include <warmjoint/simulate.h>

#include "sim/truth/truth.h"

namespace warmjoint::api {

/// Throws models::BadInput for a friction that makes no sense.
sim::Truth ToTruth(const Truth& truth);

Truth FromTruth(const sim::Truth& truth);

}  // namespace warmjoint::api
