// Friction along a map, and at one speed, with its uncertainty.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "models/foundation/field.h"

namespace warmjoint::inline identification {

/// Law and maps together at one map's centres (make_bands.h), each by itself with 95 %.
struct MapBand {
  std::vector<std::string> quantities;            // of the axes
  std::vector<std::vector<double>> points;        // [g][axes] rad or m, ...
  std::vector<double> value;                      // [g] N.m or N
  std::vector<double> std;                        // [g]
  std::vector<std::array<double, 2>> interval95;  // [g]

  template <class A>
  void Serialize(A* a) {
    constexpr std::string_view needed = "give a value for each centre";
    a->Field("quantities", &quantities, {.needed = "name those of the axes"});
    a->Field("points", &points, {.needed = needed});
    a->Field("value", &value, {.unit = "N.m", .needed = needed});
    a->Field("std", &std, {.unit = "N.m", .needed = needed});
    a->Field("interval95", &interval95, {.unit = "N.m", .needed = needed});
  }
};

/// What law and maps brake with at one speed: the mean over the places where kept samples moved so.
struct FrictionAtSpeed {
  double speed = 0;  // below 0: backwards
  double value = 0;
  double std = 0;
  std::array<double, 2> interval95{};
  std::string speed_unit{}, unit{};  // of a report; empty in a file that does not tell them

  template <class A>
  void Serialize(A* a) {
    a->Field("speed", &speed, {.unit = "rad/s", .needed = kGiveNumber});
    a->Field("value", &value, {.unit = "N.m", .needed = kGiveNumber});
    a->Field("std", &std, {.unit = "N.m", .needed = kGiveNumber});
    a->Field("interval95", &interval95, {.unit = "N.m", .needed = "give [lower, upper]"});
    a->Field("speed_unit", &speed_unit, {.at_default = AtDefault::left_out});
    a->Field("unit", &unit, {.at_default = AtDefault::left_out});
  }
};

}  // namespace warmjoint::inline identification
