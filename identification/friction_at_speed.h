// Friction at one speed, with its uncertainty.
#pragma once

#include <array>

namespace warmjoint::inline identification {

/// What law and maps brake with at one speed: the mean over the places and directions of the kept
/// samples.
struct FrictionAtSpeed {
  double speed = 0;  // rad/s or m/s
  double value = 0;  // N.m or N
  double std = 0;
  std::array<double, 2> interval95{};
};

}  // namespace warmjoint::inline identification
