// lpv-energy: a law whose parameters follow the energy.
//
// F = kv(E) v + kc(E) sign(v), Eq. (27), linear parameter-varying in E: kv(E) and kc(E) are the
// law's own values, E in kc, and kernels over E on both. E comes from energy-ml.
#include "identification/identifiers/identifier_list.h"
#include "identification/linear/linear_laws.h"
#include "identification/maps/over_energy.h"
#include "identification/physical_bounds.h"
#include "identification/warming/slope_heat.h"

namespace warmjoint {
namespace {

constexpr const char* kName = "lpv-energy";

struct LpvEnergySize {
  int energy_kernels = 4;

  template <class A>
  void Serialize(A* a) {
    a->Field("energy_kernels", &energy_kernels,
             {.bounds = {.at_least = 2, .at_most = 32},
              .meaning = "kernels over energy for each of viscous and Coulomb friction"});
  }
};

/// Kernels over E times v and times sign(v), for every width.
std::vector<std::vector<FrictionMap>> Shapes(int energy_kernels, const MapOptions& options,
                                             const MapPoints& points) {
  std::vector<std::vector<FrictionMap>> shapes;
  for (const double width : options.Widths()) {
    const MapAxis axis = RangeAxis(MapQuantity::energy, points, energy_kernels, width);
    shapes.push_back({{{axis}, options.kernel, {}, MapFactor::velocity},
                      {{axis}, options.kernel, {}, MapFactor::direction}});
  }
  return shapes;
}

Fit FitSlopeAndLevel(const IdentifierInput& input) {
  // E, from a fit whose level alone warms
  MapTask task = MakeMapTask(input.options, kName);
  const Identifier warm = EnergyMl();
  Fit first = warm.fit(input.With(warm.options.With(input.options.Get<LawOption>())));
  first.identifier = kName;
  if (!GivesFriction(first)) return first;

  // its slope did not follow the heat, for which the warming is corrected
  std::optional<Thermal>& thermal = first.friction.thermal;
  thermal = FitSlopeHeat(input, *task.law, *thermal);
  return IdentifyOverEnergy(input, task, &first, [&](const MapPoints& points) {
    return Shapes(input.options.Get<LpvEnergySize>().energy_kernels, task.settings, points);
  });
}

}  // namespace

Identifier LpvEnergy() {
  return {kName, "a law whose viscous and Coulomb friction follow the energy, Eq. (27)",
          OptionGroups<LawOption, MapOptions, LpvEnergySize>{}, &FitSlopeAndLevel};
}

}  // namespace warmjoint
