// Friction along a map, with its uncertainty.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "models/foundation/bad_input.h"

namespace warmjoint::inline identification {

/// Law and maps together at one map's centres (make_bands.h), each by itself with 95 %.
struct MapBand {
  std::vector<std::string> quantities;            // of the axes
  std::vector<std::vector<double>> points;        // [g][axes] rad or m, ...
  std::vector<double> value;                      // [g] N.m or N
  std::vector<double> std;                        // [g]
  std::vector<std::array<double, 2>> interval95;  // [g]
};

/// {quantities[], points[][], value[], std[], interval95[][]}.
nlohmann::json BandToJson(const MapBand& band);

/// The inverse. Throws BadInput from `place`.
MapBand BandFromJson(const nlohmann::json& json, const Place& place);

}  // namespace warmjoint::inline identification
