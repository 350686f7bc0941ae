// energy-map: friction over position, velocity and energy.
//
// The paper's expansion over P x V x E (40 x 6 x 3 kernels), once E is known from a fit of law,
// position map and warming together (warm_maps.h).
#include "identification/identifiers/identifier_list.h"
#include "identification/maps/map_model.h"

namespace warmjoint {
namespace {

constexpr const char* kName = "energy-map";

struct EnergyMapSize {
  int kernels = 40, velocity_kernels = 3, energy_kernels = 3;

  template <class A>
  void Serialize(A* a) {
    a->Field("kernels", &kernels,
             {.bounds = {.at_least = 2, .at_most = 128}, .meaning = "kernels over position"});
    a->Field("velocity_kernels", &velocity_kernels,
             {.bounds = {.at_least = 1, .at_most = 64},
              .meaning = "kernels over speed for each direction of motion"});
    a->Field("energy_kernels", &energy_kernels,
             {.bounds = {.at_least = 2, .at_most = 32}, .meaning = "kernels over energy"});
  }
};

Fit FitEnergyMap(const IdentifierInput& input) {
  const auto& size = input.options.Get<EnergyMapSize>();
  const auto& options = input.options.Get<MapOptions>();
  // E, with position parts in addition, one for each direction of motion
  const auto beside = [&](const MapPoints& points) {
    return ForEachWidth(options, [&](double width) -> std::vector<FrictionMap> {
      return {PositionMap(points, options.kernel, size.kernels, width)};
    });
  };
  // then one map over that E too, P x V x E
  const auto over_energy = [&](const MapPoints& points) {
    return ForEachWidth(options, [&](double width) -> std::vector<FrictionMap> {
      FrictionMap map =
          PositionMap(points, options.kernel, size.kernels, width, size.velocity_kernels);
      map.axes.push_back(RangeAxis(MapQuantity::energy, points, size.energy_kernels, width));
      return {map};
    });
  };
  return FitMapModel(kName, input,
                     {.quantities = {MapQuantity::position},
                      .maps = beside,
                      .heat = MapHeat::estimated,
                      .over_energy = over_energy});
}

}  // namespace

Identifier EnergyMap() {
  return {kName,
          "law, warming, and a map over position x velocity x energy: ripple that fades or grows "
          "as the joint warms",
          OptionGroups<LawOption, MapOptions, EnergyMapSize>{}, &FitEnergyMap};
}

}  // namespace warmjoint
