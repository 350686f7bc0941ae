#include "identification/maps/finer_maps.h"

#include <algorithm>

#include "models/friction/gaussian_axis.h"

namespace warmjoint::inline identification {
namespace {

constexpr double kNarrowest = 0.7;  // of the kernels, spacings; why: no narrower shape is tried

GaussianAxis TwiceAsFine(const GaussianAxis& axis) {
  const std::vector<double>& centres = axis.centres;
  if (centres.size() < 2) return axis;
  const auto count = static_cast<int>(std::min(2 * centres.size(), kMostMapCentres));
  GaussianAxis finer = axis.period ? CircleAxis(*axis.period, count)
                                   : EvenAxis(centres.front(), centres.back(), count);
  // where there are no more, half as wide, but not so narrow that holes are left between them
  const double spacing = finer.width;
  const double as_wide = axis.width * spacing / (centres[1] - centres[0]);
  finer.width = std::min(as_wide, std::max(axis.width / 2, kNarrowest * spacing));
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
