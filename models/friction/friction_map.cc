#include "models/friction/friction_map.h"

#include <algorithm>
#include <cmath>

namespace warmjoint::inline models {
namespace {

void CheckPositive(double value, std::string_view axis, const char* what, const Place& place) {
  if (std::isfinite(value) && value > 0) return;
  Refuse(place, "map axis {} has the {} {}; it must be a positive number", axis, what, value);
}

void CheckAxis(const MapAxis& axis, const Place& place) {
  const std::string_view name = MapQuantityName(axis.quantity);
  const GaussianAxis& kernels = axis.kernels;
  // few enough kernels, of a positive width
  if (kernels.size() < 1 || kernels.size() > kMostMapCentres) {
    Refuse(place, "map axis {} has {} centres; give 1 to {}", name, kernels.size(),
           kMostMapCentres);
  }
  CheckPositive(kernels.width, name, "width", place);
  if (kernels.period) CheckPositive(*kernels.period, name, "period", place);
  // ascending centres; with the sides apart, each on one of them
  for (size_t i = 0; i < kernels.size(); ++i) {
    const double centre = kernels.centres[i];
    if (!std::isfinite(centre) || (i > 0 && centre <= kernels.centres[i - 1])) {
      Refuse(place, "map axis {} has centre {} at place {}; centres must be finite and ascend",
             name, centre, i);
    }
    if (kernels.sides == Sides::apart && centre == 0) {
      Refuse(place, "map axis {} has a centre at 0 and its sides apart; move it to one side", name);
    }
  }
}

}  // namespace

std::string_view MapQuantityName(MapQuantity quantity) {
  switch (quantity) {
    case MapQuantity::position:
      return "position";
    case MapQuantity::motor_position:
      return "motor_position";
    case MapQuantity::velocity:
      return "velocity";
    case MapQuantity::energy:
      return "energy";
    case MapQuantity::load:
      return "load";
  }
  return "";
}

std::string_view MapFactorName(MapFactor factor) {
  switch (factor) {
    case MapFactor::one:
      return "one";
    case MapFactor::direction:
      return "direction";
    case MapFactor::velocity:
      return "velocity";
  }
  return "";
}

size_t FrictionMap::size() const {
  size_t count = 1;
  for (const MapAxis& axis : axes) count *= axis.kernels.size();
  return count;
}

const MapAxis* FindAxis(const FrictionMap& map, MapQuantity quantity) {
  const auto is = [quantity](const MapAxis& axis) { return axis.quantity == quantity; };
  const auto found = std::find_if(map.axes.begin(), map.axes.end(), is);
  return found == map.axes.end() ? nullptr : &*found;
}

void CheckMap(const FrictionMap& map, const Place& place) {
  // few axes, kernels on each, and a finite weight for each product of kernels
  if (map.axes.empty() || map.axes.size() > kMostMapAxes) {
    Refuse(place, "a map has {} axes; give 1 to {}", map.axes.size(), kMostMapAxes);
  }
  for (const MapAxis& axis : map.axes) CheckAxis(axis, place);
  if (map.weights.size() != map.size()) {
    Refuse(place, "a map has {} weights; its axes span {} kernels", map.weights.size(), map.size());
  }
  for (const double weight : map.weights) {
    if (!std::isfinite(weight)) Refuse(place, "a map has the weight {}; give numbers", weight);
  }
}

}  // namespace warmjoint::inline models
