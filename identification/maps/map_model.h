// The fit behind every identifier with maps: law, maps, and the heat that they share.
#pragma once

#include <string>
#include <vector>

#include "identification/maps/over_energy.h"
#include "identification/warming/thermal_fit.h"

namespace warmjoint {

/// Whether law and maps warm.
enum class MapHeat {
  none,
  estimated,   // together with law and maps; without a warming there is no fit
  where_seen,  // or none
};

/// What an identifier fits maps over, of which shapes, with what heat.
struct MapModel {
  std::vector<MapQuantity> quantities;  // that the log must have, and vary
  MapMaker maps;                        // beside the law, to choose from
  MapHeat heat = MapHeat::none;
  /// Maps over E and others in their place, once the heat is known; or none. Where no heat is seen, over the others.
  MapMaker over_energy{};
};

/// What a model is fitted to: its task with gravity, inertia and all shapes of maps, for the samples that
/// `task.rigid` keeps; or why there is none.
MapBeginning BeginModel(const std::string& name, const IdentifierInput& given,
                        const MapModel& model);

/// By ridge regression on the kernels' weights, with gravity and inertia where the options ask for them; with heat in
/// turns (warm_maps.h), from the E(0) that the options say. name: of the identifier
Fit FitMapModel(const std::string& name, const IdentifierInput& given, const MapModel& model);

}  // namespace warmjoint
