#include "identification/lpv_energy.h"

#include "identification/energy_ml.h"
#include "identification/fit_data.h"
#include "identification/over_energy.h"

namespace warmjoint {
namespace {

constexpr const char* kName = "lpv-energy";

/// Kernels over E times v and times sign(v), for every width.
std::vector<std::vector<FrictionMap>> Shapes(const Options& options, const MapSettings& settings,
                                             const MapPoints& points) {
  std::vector<std::vector<FrictionMap>> shapes;
  for (const double width : settings.widths) {
    const MapAxis axis =
        RangeAxis(MapQuantity::energy, points, options.Integer("energy_kernels"), width);
    shapes.push_back({{{axis}, settings.kernels, {}, MapFactor::velocity},
                      {{axis}, settings.kernels, {}, MapFactor::direction}});
  }
  return shapes;
}

Estimate Identify(const IdentifierInput& input) {
  MapTask task{kName, ReadMapSettings(input.options), {}, {}};
  const Identifier warm = EnergyMl();
  const Options options(warm.options, {{"law", task.settings.law}}, {kName});
  Estimate first = warm.identify({input.measurements, input.selection, options, input.random});
  first.identifier = kName;
  if (first.status != Status::ok || !first.friction) return first;
  return IdentifyOverEnergy(input, task, EnergyOf(first), [&](const MapPoints& points) {
    return Shapes(input.options, task.settings, points);
  });
}

}  // namespace

Identifier LpvEnergy() {
  std::vector<OptionInfo> options = MapOptions();
  options.push_back({"energy_kernels", "4", "integer >= 2 <= 32",
                     "kernels over energy for each of viscous and Coulomb friction"});
  return {kName, "a law whose viscous and Coulomb friction follow the energy, Eq. (27)", options,
          &Identify};
}

}  // namespace warmjoint
