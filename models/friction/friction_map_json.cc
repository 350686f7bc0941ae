#include "models/friction/friction_map_json.h"

#include <nlohmann/json.hpp>

#include "models/foundation/excerpt.h"
#include "models/foundation/json_members.h"
#include "models/foundation/nearest_name.h"
#include "models/friction/check_friction.h"

namespace warmjoint::inline models {
namespace {

using nlohmann::json;

constexpr MapQuantity kQuantities[] = {MapQuantity::position, MapQuantity::motor_position,
                                       MapQuantity::velocity, MapQuantity::energy,
                                       MapQuantity::load};
constexpr MapFactor kFactors[] = {MapFactor::one, MapFactor::direction, MapFactor::velocity};

/// Refuses what is no object, and keys that are not `known`; the first `needed` must be there.
void CheckKeys(const json& object, const char* what, const std::vector<std::string>& known,
               size_t needed, const Place& place) {
  RefuseUnknownKeys(object, what, known, place);
  for (size_t i = 0; i < needed; ++i) {
    if (!object.contains(known[i])) Refuse(place, "{} lacks its {}", what, known[i]);
  }
}

std::vector<double> Numbers(const json& list, const char* what, const Place& place) {
  if (!list.is_array()) Refuse(place, "{} must be a list of numbers", what);
  std::vector<double> numbers;
  for (const json& value : list) numbers.push_back(NumberFrom(value, what, place));
  return numbers;
}

/// Index of a word among `words`.
size_t Word(const json& value, const char* what, const std::vector<std::string>& words,
            const Place& place) {
  // a word, or whatever stands there instead
  const std::string given = value.is_string() ? value.get<std::string>() : value.dump();
  for (size_t i = 0; value.is_string() && i < words.size(); ++i) {
    if (given == words[i]) return i;
  }
  Refuse(place, "{} is '{}'{}", what, Excerpt(given), Suggestion(given, words));
}

MapAxis AxisFromJson(const json& object, const Place& place) {
  CheckKeys(object, "a map's axis", {"quantity", "centres", "width", "period", "sides"}, 3, place);
  std::vector<std::string> names;
  for (const MapQuantity quantity : kQuantities) names.emplace_back(MapQuantityName(quantity));

  MapAxis axis;
  axis.quantity = kQuantities[Word(object["quantity"], "a map axis's quantity", names, place)];
  axis.kernels.centres = Numbers(object["centres"], "centres of a map's axis", place);
  axis.kernels.width = NumberFrom(object["width"], "width of a map's axis", place);
  // what may be left out
  if (object.contains("period")) {
    axis.kernels.period = NumberFrom(object["period"], "period of a map's axis", place);
  }
  if (object.contains("sides")) {
    const size_t sides =
        Word(object["sides"], "sides of a map's axis", {"together", "apart"}, place);
    axis.kernels.sides = sides == 1 ? Sides::apart : Sides::together;
  }
  return axis;
}

}  // namespace

json MapToJson(const FrictionMap& map) {
  // a period only where the axis is a circle
  json axes = json::array();
  for (const MapAxis& axis : map.axes) {
    json object{{"quantity", MapQuantityName(axis.quantity)},
                {"centres", axis.kernels.centres},
                {"width", axis.kernels.width},
                {"sides", axis.kernels.sides == Sides::apart ? "apart" : "together"}};
    if (axis.kernels.period) object["period"] = *axis.kernels.period;
    axes.push_back(object);
  }
  return {{"axes", axes},
          {"kernels", map.kernels == KernelKind::normalised ? "normalised" : "plain"},
          {"factor", MapFactorName(map.factor)},
          {"weights", map.weights}};
}

FrictionMap MapFromJson(const json& object, const Place& place) {
  CheckKeys(object, "a map", {"axes", "weights", "kernels", "factor"}, 2, place);
  if (!object["axes"].is_array()) Refuse(place, "a map's axes must be a list");
  FrictionMap map;
  for (const json& axis : object["axes"]) map.axes.push_back(AxisFromJson(axis, place));
  map.weights = Numbers(object["weights"], "a map's weights", place);
  // what may be left out
  if (object.contains("kernels")) {
    const size_t kind = Word(object["kernels"], "a map's kernels", {"normalised", "plain"}, place);
    map.kernels = kind == 1 ? KernelKind::plain : KernelKind::normalised;
  }
  if (object.contains("factor")) {
    std::vector<std::string> names;
    for (const MapFactor factor : kFactors) names.emplace_back(MapFactorName(factor));
    map.factor = kFactors[Word(object["factor"], "a map's factor", names, place)];
  }
  CheckMap(map, place);
  return map;
}

}  // namespace warmjoint::inline models
