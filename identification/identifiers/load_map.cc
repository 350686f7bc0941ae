#include "identification/identifiers/load_map.h"

#include <fmt/format.h>

#include "identification/fit_data.h"
#include "identification/inference/inference.h"
#include "identification/maps/over_energy.h"
#include "identification/maps/warm_maps.h"

namespace warmjoint::inline identification {
namespace {

constexpr const char* kName = "load-map";

/// Levels over the load alone, or over position, energy and load, for every width.
std::vector<std::vector<FrictionMap>> Shapes(const Options& options, const MapSettings& settings,
                                             const MapPoints& points,
                                             const std::vector<MapQuantity>& quantities) {
  std::vector<std::vector<FrictionMap>> shapes;
  for (const double width : settings.widths) {
    FrictionMap map{{}, settings.kernels, {}, MapFactor::direction};
    for (const MapQuantity quantity : quantities) {
      const std::string option = fmt::format("{}_kernels", NameOf(quantity));
      map.axes.push_back(RangeAxis(quantity, points, options.Integer(option), width));
    }
    shapes.push_back({map});
  }
  return shapes;
}

Fit FitLoadMap(const IdentifierInput& input) {
  MapBeginning begin = BeginMaps(input, kName, {MapQuantity::position, MapQuantity::load});
  if (begin.refusal) return Refused(kName, *begin.refusal);
  MapTask& task = begin.task;

  // E, with the load's part beside it
  task.candidates = Shapes(input.options, task.settings, begin.points, {MapQuantity::load});
  const std::optional<WarmMaps> warm = FitWarmMaps(input, task);
  if (!warm) return Refused(kName, Unsolvable());
  const Fit first = AsFit(input, *warm);
  const Inference told = Infer(first);
  const Fit* warming = told.gives_friction ? &first : nullptr;

  // the level over all of them
  const auto maker = [&](const MapPoints& warm_points) {
    std::vector<MapQuantity> quantities{MapQuantity::position, MapQuantity::energy,
                                        MapQuantity::load};
    if (!warming) std::erase(quantities, MapQuantity::energy);
    return Shapes(input.options, task.settings, warm_points, quantities);
  };
  Fit fit = IdentifyOverEnergy(input, task, warming, maker);
  if (!warming && Infer(fit).status == Status::ok) {
    fit.afterword += "; without warming: " + told.message;
  }
  return fit;
}

}  // namespace

Identifier LoadMap() {
  std::vector<OptionInfo> options = MapOptions();
  options.push_back({"position_kernels", "10", "integer >= 1 <= 128", "kernels over position"});
  options.push_back({"energy_kernels", "3", "integer >= 2 <= 32", "kernels over energy"});
  options.push_back({"load_kernels", "4", "integer >= 2 <= 32", "kernels over load"});
  return {kName, "law, warming, and a level over position x energy x load; needs the column load",
          options, &FitLoadMap};
}

}  // namespace warmjoint::inline identification
