// How large the gain of a thermal stage may be.
#pragma once

namespace warmjoint::inline models {

/// In size, N.m/W or N/W; joints show some 1 N.m/W, and a larger number is one that slipped.
inline constexpr double kLargestThermalGain = 1e6;

}  // namespace warmjoint::inline models
