// Of a law: its parameters outside of their bounds, and columns that the motion does not distinguish.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "identification/fit.h"

namespace warmjoint {

/// A parameter of the law outside of its physical bound.
struct Excess {
  const FitParameter& parameter;
  std::optional<std::array<double, 2>> interval95;
  double bound = 0;
  bool below = false;   // the bound; else above
  bool beyond = false;  // with its whole 95 % interval
};

/// Of parameters that were set to their bounds.
std::string ExplainHeld(const std::vector<Excess>& held);
/// Of a law that does not describe the data: by one of its parameters, or since friction rises from rest.
std::string ExplainExcess(const Excess& excess, const Fit& fit);
std::string ExplainRiseFromRest(const Fit& fit);

}  // namespace warmjoint
