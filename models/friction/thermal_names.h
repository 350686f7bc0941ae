// What the numbers of warming are called in files and attributes.
#pragma once

#include <string_view>

#include "models/friction/thermal.h"

namespace warmjoint::inline models {

inline constexpr std::string_view kGainName = Thermal::parameters[0].name;
inline constexpr std::string_view kTimeConstantName = Thermal::parameters[1].name;

/// Stands before both in a second stage.
inline constexpr std::string_view kSecondStage = "second_";

/// The sampled pair of Eq. (22).
inline constexpr std::string_view kDiscreteGainName = "thermal_gain_discrete";
inline constexpr std::string_view kPoleName = "thermal_pole";

}  // namespace warmjoint::inline models
