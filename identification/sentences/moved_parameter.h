// What sentences of several topics are about.
#pragma once

#include "identification/fit/fit.h"

namespace warmjoint {

/// A parameter, and how far something changes it, in its unit.
struct MovedParameter {
  const Unknown& parameter;
  double change = 0;
};

}  // namespace warmjoint
