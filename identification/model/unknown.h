// The table of a fit's unknowns: names, units, bounds and priors in one place.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <string>

#include "identification/fit.h"

namespace warmjoint {

/// What is known of an unknown before the data, in its coordinate.
struct Normal {
  double mean = 0;
  double deviation = 1;
};

/// A row of the table. The fit works in x: the value, or its logarithm.
struct Unknown {
  std::string name;  // in estimate.json; empty: a nuisance that reports leave out
  Role role = Role::law;
  std::string unit;
  Coordinate coordinate = Coordinate::value;
  double start = 0;                              // x at which the fit begins
  double lower = -kInfinity, upper = kInfinity;  // of x
  std::optional<Normal> prior{};
  double largest_step = kInfinity;  // of x in one iteration, where the model is not linear
  LawPart part = LawPart::other;
};

}  // namespace warmjoint
