#include "identification/energy_map.h"

#include "identification/fit_data.h"
#include "identification/over_energy.h"
#include "identification/position_maps.h"
#include "identification/warm_maps.h"

namespace warmjoint {
namespace {

constexpr const char* kName = "energy-map";

/// P x V x E, for every width.
std::vector<std::vector<FrictionMap>> Shapes(const Options& options, const MapSettings& settings,
                                             const MapPoints& points) {
  std::vector<std::vector<FrictionMap>> shapes;
  for (const double width : settings.widths) {
    shapes.push_back(
        {{{RangeAxis(MapQuantity::position, points, options.Integer("kernels"), width),
           VelocityAxis(points, options.Integer("velocity_kernels"), width),
           RangeAxis(MapQuantity::energy, points, options.Integer("energy_kernels"), width)},
          settings.kernels,
          {}}});
  }
  return shapes;
}

/// Position parts for the first fit: one part for each direction of motion.
std::vector<std::vector<FrictionMap>> PositionParts(const Options& options,
                                                    const MapSettings& settings,
                                                    const MapPoints& points) {
  std::vector<std::vector<FrictionMap>> parts;
  for (const double width : settings.widths) {
    parts.push_back({{{RangeAxis(MapQuantity::position, points, options.Integer("kernels"), width),
                       VelocityAxis(points, 1, width)},
                      settings.kernels,
                      {}}});
  }
  return parts;
}

Estimate Identify(const IdentifierInput& input) {
  MapTask task{kName, ReadMapSettings(input.options), {}, {}};
  if (auto refusal = RefuseForMaps(input, kName, *FindLaw(task.settings.law))) return *refusal;
  const MapPoints points = Kept(PointsOf(input.measurements), input.selection);
  if (auto why = CannotCarry(MapQuantity::position, points)) {
    return Failed(kName, Status::bad_data, *why);
  }

  // E, with position parts beside it
  task.candidates = PositionParts(input.options, task.settings, points);
  const std::optional<WarmMaps> warm = FitWarmMaps(input, task);
  if (!warm) return Unsolvable(kName);
  Estimate first = ReportWarmMaps(input, *warm);
  if (first.status != Status::ok || !first.friction) return first;

  Estimate estimate =
      IdentifyOverEnergy(input, task, EnergyOf(first), [&](const MapPoints& warm_points) {
        return Shapes(input.options, task.settings, warm_points);
      });
  return estimate;
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
          options, &Identify};
}

}  // namespace warmjoint
