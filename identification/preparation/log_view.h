// A log and the samples of it that take part in fits.
#pragma once

#include "models/recording/measurements.h"
#include "models/recording/selection.h"

namespace warmjoint::inline identification {

struct LogView {
  Measurements measurements;
  Selection selection;
};

}  // namespace warmjoint::inline identification
