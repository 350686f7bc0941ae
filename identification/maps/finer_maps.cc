#include "identification/maps/finer_maps.h"

#include <algorithm>

#include "models/friction/gaussian_axis.h"

namespace warmjoint::inline identification {
namespace {

GaussianAxis TwiceAsFine(const GaussianAxis& axis) {
  const std::vector<double>& centres = axis.centres;
  if (centres.size() < 2) return axis;
  const auto count = static_cast<int>(std::min(2 * centres.size(), kMostMapCentres));
  GaussianAxis finer = axis.period ? CircleAxis(*axis.period, count)
                                   : EvenAxis(centres.front(), centres.back(), count);
  finer.width = axis.width * (finer.centres[1] - finer.centres[0]) / (centres[1] - centres[0]);
  return finer;
}

}  // namespace

std::vector<FrictionMap> TwiceAsFine(std::vector<FrictionMap> maps) {
  for (FrictionMap& map : maps) {
    map.weights.clear();
    const MapQuantity over = map.axes[0].quantity;
    if (over != MapQuantity::position && over != MapQuantity::motor_position) continue;
    map.axes[0].kernels = TwiceAsFine(map.axes[0].kernels);
  }
  return maps;
}

}  // namespace warmjoint::inline identification
