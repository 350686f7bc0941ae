#include "identification/identifiers/lpv_energy.h"

#include "identification/fit_data.h"
#include "identification/identifiers/energy_ml.h"
#include "identification/maps/over_energy.h"
#include "identification/warming/report_thermal.h"
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

/// The warming of a first fit whose slope did not follow the heat, corrected for that.
KnownEnergy Corrected(const IdentifierInput& input, const Law& law, KnownEnergy known) {
  if (!known.friction) return known;
  const Thermal thermal = FitSlopeHeat(input, law, *known.friction->thermal);
  known.friction->thermal = thermal;
  Estimate reported;
  ReportThermal(thermal, {}, 0, input.measurements, reported);
  known.thermal = reported.parameters;
  return known;
}

Estimate Identify(const IdentifierInput& input) {
  MapTask task{kName, ReadMapSettings(input.options), {}, {}};
  const Identifier warm = EnergyMl();
  const Options options(warm.options, {{"law", task.settings.law}}, {kName});
  Estimate first = warm.identify({input.measurements, input.selection, options, input.random});
  first.identifier = kName;
  if (first.status != Status::ok || !first.friction) return first;
  const KnownEnergy known = Corrected(input, *FindLaw(task.settings.law), EnergyOf(first));
  return IdentifyOverEnergy(input, task, known, [&](const MapPoints& points) {
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

}  // namespace warmjoint::inline identification
