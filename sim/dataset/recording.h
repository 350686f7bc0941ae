// The two halves of a simulated run, kept apart by type.
#pragma once

#include "sim/dataset/measurements.h"
#include "sim/dataset/truth.h"

namespace warmjoint {

struct Recording {
  Measurements measurements;
  Truth truth;
};

}  // namespace warmjoint
