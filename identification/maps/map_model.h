// The fit that every identifier with maps makes: law, maps, and the heat that they share.
#pragma once

#include <warmjoint/friction.h>

#include <functional>
#include <string>
#include <vector>

#include "identification/maps/identify_maps.h"

namespace warmjoint {

/// Shapes of maps for points whose energy is known. points: [n x 5] kept.
using MapMaker = std::function<MapShapes(const MapPoints& points)>;

/// Whether law and maps warm.
enum class MapHeat {
  none,
  estimated,   // together with law and maps; without a warming there is no fit
  where_seen,  // where the log shows a warming, else without
  of_law,      // as a law without maps has it (fit_law.h), or no fit
};

/// What an identifier fits maps over, of which shapes, with what heat.
struct MapModel {
  std::vector<MapQuantity> quantities{};  // that the log must have, and vary
  MapMaker maps{};  // in addition to the law, to choose from; not read with of_law
  MapHeat heat = MapHeat::none;
  /// With of_law: the warming where more than the law's level depends on the heat, given the warming `found`; or none.
  Thermal (*heat_of_all)(const IdentifierInput& input, const Law& law,
                         const Thermal& found) = nullptr;
  /// Maps over E and others in their place, once the heat is known; or none. Where no heat is seen, over the others.
  MapMaker over_energy{};
};

/// What a model is fitted to: its task with gravity, inertia and all shapes of maps, for the samples that
/// `task.rigid` keeps; or why there is none.
MapBeginning BeginModel(const std::string& name, const IdentifierInput& given,
                        const MapModel& model);

/// Fits by ridge regression on the kernels' weights, with gravity and inertia where the options ask for them. With heat the fit
/// alternates between heat and maps (warm_maps.h), from the E(0) that the options say.
///
/// Over E, F = Fn(v) + sign(v) E + maps: E comes from the fit with heat, with its start and its jumps; law and maps are
/// fitted to what it leaves of the torque; then the whole friction predicts E anew, until E changes by less than 1e-4 of its
/// range. So the friction of the fit is consistent with its own heat. Gain and time constant stay as they were, without
/// intervals, since the maps take up a part of their effect. name: of the identifier
Fit FitMapModel(const std::string& name, const IdentifierInput& given, const MapModel& model);

}  // namespace warmjoint
