#include "identification/identifiers/energy_map.h"

#include "identification/maps/over_energy.h"
#include "identification/maps/position_maps.h"
#include "identification/maps/warm_maps.h"
#include "identification/physical_bounds.h"

namespace warmjoint::inline identification {
namespace {

constexpr const char* kName = "energy-map";

/// P x V x E, for every width.
std::vector<std::vector<FrictionMap>> Shapes(const Options& options, const MapSettings& settings,
                                             const MapPoints& points) {
  std::vector<std::vector<FrictionMap>> shapes;
  for (const double width : settings.widths) {
    FrictionMap map = PositionMap(points, settings.kernels, options.Integer("kernels"), width,
                                  options.Integer("velocity_kernels"));
    map.axes.push_back(
        RangeAxis(MapQuantity::energy, points, options.Integer("energy_kernels"), width));
    shapes.push_back({map});
  }
  return shapes;
}

Fit FitEnergyMap(const IdentifierInput& input) {
  MapBeginning begin = BeginMaps(input, kName, {MapQuantity::position});
  if (begin.refusal) return Refused(kName, *begin.refusal);
  MapTask& task = begin.task;

  // E, with position parts beside it, one for each direction of motion
  for (const double width : task.settings.widths) {
    task.candidates.push_back({PositionMap(begin.points, task.settings.kernels,
                                           input.options.Integer("kernels"), width)});
  }
  const std::optional<WarmMaps> warm = FitWarmMaps(input, task);
  if (!warm) return Refused(kName, Unsolvable());
  const Fit first = AsFit(input, *warm);
  if (!GivesFriction(first)) return first;

  // the map over that E too
  return IdentifyOverEnergy(input, task, &first, [&](const MapPoints& points) {
    return Shapes(input.options, task.settings, points);
  });
}

}  // namespace

Identifier EnergyMap() {
  std::vector<OptionInfo> options = MapOptions();
  options.push_back({"kernels", "40", "integer >= 2 <= 128", "kernels over position"});
  options.push_back({"velocity_kernels", "3", "integer >= 1 <= 64",
                     "kernels over speed for each direction of motion"});
  options.push_back({"energy_kernels", "3", "integer >= 2 <= 32", "kernels over energy"});
  return {kName,
          "law, warming, and a map over position x velocity x energy: ripple that fades or grows "
          "as the joint warms",
          options, &FitEnergyMap};
}

}  // namespace warmjoint::inline identification
