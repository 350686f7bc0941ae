#include "identification/identifiers/lpv_energy.h"

#include "identification/identifiers/energy_ml.h"
#include "identification/maps/over_energy.h"
#include "identification/physical_bounds.h"
#include "identification/read_options.h"
#include "identification/warming/slope_heat.h"

namespace warmjoint::inline identification {
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

Fit FitSlopeAndLevel(const IdentifierInput& input) {
  // E, from a fit whose level alone warms
  MapTask task{kName, ReadMapSettings(input.options), {}, {}};
  const Identifier warm = EnergyMl();
  const Options options = ReadOptions(warm.options, {{"law", task.settings.law}}, {kName});
  Fit first = warm.fit(input.With(options));
  first.identifier = kName;
  if (!GivesFriction(first)) return first;

  // its slope did not follow the heat, for which the warming is corrected
  std::optional<Thermal>& thermal = first.friction.thermal;
  thermal = FitSlopeHeat(input, *FindLaw(task.settings.law), *thermal);
  return IdentifyOverEnergy(input, task, &first, [&](const MapPoints& points) {
    return Shapes(input.options, task.settings, points);
  });
}

}  // namespace

Identifier LpvEnergy() {
  std::vector<OptionInfo> options = MapOptions();
  options.push_back({"energy_kernels", "4", "integer >= 2 <= 32",
                     "kernels over energy for each of viscous and Coulomb friction"});
  return {kName, "a law whose viscous and Coulomb friction follow the energy, Eq. (27)", options,
          &FitSlopeAndLevel};
}

}  // namespace warmjoint::inline identification
