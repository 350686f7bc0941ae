#include "models/friction/friction_map.h"

#include <algorithm>
#include <array>

namespace warmjoint::inline models {

std::span<const Word<MapQuantity>> WordsOf(MapQuantity) {
  static constexpr std::array words{
      Word{"position", MapQuantity::position}, Word{"motor_position", MapQuantity::motor_position},
      Word{"velocity", MapQuantity::velocity}, Word{"energy", MapQuantity::energy},
      Word{"load", MapQuantity::load}};
  return words;
}

std::span<const Word<MapFactor>> WordsOf(MapFactor) {
  static constexpr std::array words{Word{"one", MapFactor::one},
                                    Word{"direction", MapFactor::direction},
                                    Word{"velocity", MapFactor::velocity}};
  return words;
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
