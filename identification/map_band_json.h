// Bands along maps as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "identification/map_band.h"
#include "models/foundation/bad_input.h"

namespace warmjoint::inline identification {

/// {quantities[], points[][], value[], std[], interval95[][]}.
nlohmann::json BandToJson(const MapBand& band);

/// The inverse. Throws BadInput from `place`.
MapBand BandFromJson(const nlohmann::json& json, const Place& place);

}  // namespace warmjoint::inline identification
