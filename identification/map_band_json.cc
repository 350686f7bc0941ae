#include "identification/map_band_json.h"

#include <nlohmann/json.hpp>

namespace warmjoint::inline identification {

using nlohmann::json;

json BandToJson(const MapBand& band) {
  return {{"quantities", band.quantities},
          {"points", band.points},
          {"value", band.value},
          {"std", band.std},
          {"interval95", band.interval95}};
}

MapBand BandFromJson(const json& object, const Place& place) {
  MapBand band;
  // the library refuses members that are absent or of another kind
  try {
    object.at("quantities").get_to(band.quantities);
    object.at("points").get_to(band.points);
    object.at("value").get_to(band.value);
    object.at("std").get_to(band.std);
    object.at("interval95").get_to(band.interval95);
  } catch (const json::exception& error) {
    Refuse(place, "a band of the estimate cannot be read: {}", error.what());
  }
  return band;
}

}  // namespace warmjoint::inline identification
