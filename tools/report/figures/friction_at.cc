#include "tools/report/figures/friction_at.h"

namespace warmjoint::report {

double FrictionAt(const FrictionDescription& friction, const std::vector<FrictionMap>& maps,
                  const MapPoint<double>& point) {
  const double v = point[static_cast<size_t>(MapQuantity::velocity)];
  const double energy = point[static_cast<size_t>(MapQuantity::energy)];
  const std::vector<double> values = LawValues(friction);
  double force = FindLaw(friction.law)->force(v, values.data()) + Sign(v) * energy;
  for (const FrictionMap& map : maps) force += EvaluateMap(map, point);
  return force;
}

const MapAxis* FindAxis(const FrictionMap& map, MapQuantity quantity) {
  for (const MapAxis& axis : map.axes) {
    if (axis.quantity == quantity) return &axis;
  }
  return nullptr;
}

}  // namespace warmjoint::report
