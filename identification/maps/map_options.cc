#include "identification/maps/map_options.h"

#include <fmt/format.h>

#include <numbers>

namespace warmjoint {
namespace {

Eigen::VectorXd Column(MapQuantity quantity, const MapPoints& points) {
  return points.col(static_cast<int>(quantity));
}

}  // namespace

MapAxis RangeAxis(MapQuantity quantity, const MapPoints& points, int count, double width) {
  const Eigen::VectorXd x = Column(quantity, points);
  MapAxis axis{quantity, EvenAxis(x.minCoeff(), x.maxCoeff(), count)};
  axis.kernels.width *= width;
  return axis;
}

MapAxis VelocityAxis(const MapPoints& points, int count, double width) {
  const Eigen::VectorXd speed = Column(MapQuantity::velocity, points).cwiseAbs();
  const double lowest = speed.minCoeff(), highest = speed.maxCoeff();
  const bool one = count == 1 || !(highest - lowest > 1e-6 * highest);
  MapAxis axis{MapQuantity::velocity,
               one ? SpeedAxis(highest, highest, 1) : SpeedAxis(lowest, highest, count)};
  // one kernel a side is 1 on its side, plain or not
  axis.kernels.width *= one ? 1e6 : width;
  return axis;
}

MapAxis TurnAxis(MapQuantity angle, int count, double width) {
  MapAxis axis{angle, CircleAxis(2 * std::numbers::pi, count)};
  axis.kernels.width *= width;
  return axis;
}

FrictionMap PositionMap(const MapPoints& points, KernelKind kernels, int count, double width,
                        int speeds) {
  FrictionMap map{{RangeAxis(MapQuantity::position, points, count, width)}, kernels, {}};
  if (speeds > 0) map.axes.push_back(VelocityAxis(points, speeds, width));
  return map;
}

MapShapes PositionMaps(const Options& options, const MapPoints& points) {
  const auto& made = options.Get<MapOptions>();
  const auto& [basis, kernels, velocity_kernels] = options.Get<PositionMapOptions>();
  const std::vector<int> counts =
      kernels > 0 ? std::vector{kernels} : std::vector{10, 20, 40, 80, 128};
  // centres over speed in each direction; none where both directions share the map
  const int speeds = basis == MapBasis::position   ? 0
                     : basis == MapBasis::velocity ? velocity_kernels
                                                   : 1;
  MapShapes candidates;
  for (const int count : counts) {
    for (const double width : made.Widths()) {
      candidates.push_back({PositionMap(points, made.kernel, count, width, speeds)});
    }
  }
  return candidates;
}

std::optional<std::string> CannotCarry(MapQuantity quantity, const MapPoints& points) {
  const Eigen::VectorXd x = Column(quantity, points);
  const std::string_view name = NameOf(quantity);
  if (!x.allFinite()) {
    return fmt::format("{} is not a finite number at some sample; repair or remove it", name);
  }
  const double range = x.maxCoeff() - x.minCoeff();
  if (!(range > 1e-9 * x.cwiseAbs().maxCoeff())) {
    return fmt::format(
        "{} is {:.6g} at all samples, so that no map over it can be estimated; vary it", name,
        x[0]);
  }
  return std::nullopt;
}

}  // namespace warmjoint
