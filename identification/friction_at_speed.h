// Friction at one speed, with its uncertainty.
#pragma once

#include <array>
#include <string>

namespace warmjoint::inline identification {

/// What law and maps brake with at one speed: the mean over the places and directions of the kept
/// samples.
struct FrictionAtSpeed {
  double speed = 0;
  double value = 0;
  double std = 0;
  std::array<double, 2> interval95{};
  std::string speed_unit{}, unit{};  // of a report; empty in a file that does not tell them
};

}  // namespace warmjoint::inline identification
