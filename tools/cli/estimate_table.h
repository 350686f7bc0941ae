// An estimate for people.
#pragma once

#include <string>

#include "identification/estimate.h"
#include "models/recording/measurements.h"

namespace warmjoint::inline tools {

/// Status sentence, parameters with units, standard deviations and 95 % intervals, and how well
/// they agree with the data and with the part held out.
std::string EstimateToText(const Estimate& estimate, const Measurements& measurements);

}  // namespace warmjoint::inline tools
