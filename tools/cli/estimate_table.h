// An estimate for people.
#pragma once

#include <string>

#include "identification/estimate.h"
#include "models/recording/measurements.h"
#include "tools/terminal/say.h"

namespace warmjoint::inline tools {

/// How much is said of a verdict.
enum class Detail { brief, full };

/// Status, what is to be said of it, parameters with units, standard deviations and 95 % intervals, and
/// how well they agree with the data and with the part held out. Brief: the first three remarks; full: all of
/// them, with every test for lack of fit and every assumption.
std::string EstimateToText(const Estimate& estimate, const Measurements& measurements,
                           const Page& page, Detail detail);

}  // namespace warmjoint::inline tools
