// The two halves of a simulated run, kept apart by type.
#pragma once

#include "models/recording/measurements.h"
#include "sim/truth/truth.h"

namespace warmjoint::inline sim {

struct Recording {
  Measurements measurements;
  Truth truth;
};

}  // namespace warmjoint::inline sim
