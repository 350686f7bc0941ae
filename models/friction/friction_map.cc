#include "models/friction/friction_map.h"

#include <algorithm>

namespace warmjoint::inline models {

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

}  // namespace warmjoint::inline models
