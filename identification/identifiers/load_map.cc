// load-map: friction over position, energy and load.
//
// The paper's proposal P x E x L: a level that depends on the load which the joint transmits. The
// recording must have the column `load`. Where no warm-up can be seen E is 0 and its axis left
// out.
#include "identification/identifiers/identifier_list.h"
#include "identification/maps/map_model.h"

namespace warmjoint {
namespace {

constexpr const char* kName = "load-map";

struct LoadMapSize {
  int position_kernels = 10, energy_kernels = 3, load_kernels = 4;

  template <class A>
  void Serialize(A* a) {
    a->Field("position_kernels", &position_kernels,
             {.bounds = {.at_least = 1, .at_most = 128}, .meaning = "kernels over position"});
    a->Field("energy_kernels", &energy_kernels,
             {.bounds = {.at_least = 2, .at_most = 32}, .meaning = "kernels over energy"});
    a->Field("load_kernels", &load_kernels,
             {.bounds = {.at_least = 2, .at_most = 32}, .meaning = "kernels over load"});
  }
};

/// An axis of maps, and its kernels.
struct AxisSize {
  MapQuantity quantity;
  int kernels;
};

/// Levels over the load alone, or over position, energy and load, for every width.
MapShapes Shapes(const MapOptions& options, const MapPoints& points,
                 const std::vector<AxisSize>& axes) {
  return ForEachWidth(options, [&](double width) -> std::vector<FrictionMap> {
    FrictionMap map{{}, options.kernel, {}, MapFactor::direction};
    for (const auto& [quantity, kernels] : axes) {
      map.axes.push_back(RangeAxis(quantity, points, kernels, width));
    }
    return {map};
  });
}

Fit FitLoadMap(const IdentifierInput& input) {
  const auto& size = input.options.Get<LoadMapSize>();
  const auto& options = input.options.Get<MapOptions>();
  const AxisSize load{MapQuantity::load, size.load_kernels};
  // E, with the load's part in addition; then the level over all of them
  return FitMapModel(
      kName, input,
      {.quantities = {MapQuantity::position, MapQuantity::load},
       .maps = [&](const MapPoints& points) { return Shapes(options, points, {load}); },
       .heat = MapHeat::where_seen,
       .over_energy =
           [&](const MapPoints& points) {
             std::vector<AxisSize> axes{{MapQuantity::position, size.position_kernels}};
             const bool warms = !CannotCarry(MapQuantity::energy, points);
             if (warms) axes.push_back({MapQuantity::energy, size.energy_kernels});
             axes.push_back(load);
             return Shapes(options, points, axes);
           }});
}

}  // namespace

Identifier LoadMap() {
  return {kName, "law, warming, and a level over position x energy x load; needs the column load",
          OptionGroups<LawOption, MapOptions, LoadMapSize>{}, &FitLoadMap};
}

}  // namespace warmjoint
