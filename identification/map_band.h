// Friction along a map, with its uncertainty.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace warmjoint::inline identification {

/// Law and maps together at one map's centres (make_bands.h), each by itself with 95 %.
struct MapBand {
  std::vector<std::string> quantities;            // of the axes
  std::vector<std::vector<double>> points;        // [g][axes] rad or m, ...
  std::vector<double> value;                      // [g] N.m or N
  std::vector<double> std;                        // [g]
  std::vector<std::array<double, 2>> interval95;  // [g]
};

}  // namespace warmjoint::inline identification
