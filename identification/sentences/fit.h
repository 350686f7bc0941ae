// Of how a fit was made, and whether it came to rest.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "identification/inference/cause.h"

namespace warmjoint {

inline constexpr const char* kNoIntervalsInTurn = "gives no intervals, energy-ml does";
inline constexpr const char* kNoIntervalsOfOnePass = "intervals need more than one pass";
inline constexpr const char* kPassesStillMove =
    "the last pass still moved parameters by more than their standard deviation; give more passes, "
    "or try --identifier energy-ml";
inline constexpr const char* kForced = "forced: all numbers are void";

/// Of an alternation that did not arrive. remaining: share by which parameters will still change
std::string ExplainStopped(std::size_t iterations, double rate, double remaining, double tolerance);

/// Of structure in the residual that intervals were widened for, or that leaves none (drop_intervals). name: of the
/// parameter that changes by most standard errors, `deviations`, where it counts as noise
std::string ExplainStructure(std::string_view name, double deviations, Action action);

}  // namespace warmjoint
