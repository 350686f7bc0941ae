// Maps over the energy, once it is known.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "identification/maps/identify_maps.h"

namespace warmjoint::inline identification {

/// What a first fit knows of the warming; without `friction` nothing warms.
struct KnownEnergy {
  std::optional<FrictionDescription> friction;  // its thermal part is kept; it predicts E
  std::vector<EstimatedParameter> thermal;      // thermal_gain, ... with their intervals
};

/// The thermal part of an estimate.
KnownEnergy EnergyOf(const Estimate& estimate);

/// Shapes of maps for points whose energy is known. points: [n x 5] kept.
using MapMaker = std::function<std::vector<std::vector<FrictionMap>>(const MapPoints& points)>;

/// F = Fn(v) + sign(v) E + maps over E and other quantities. E comes from the first fit; law and
/// maps are fitted to what it leaves of the torque; then the whole friction predicts E anew, until
/// E rests to 1e-4 of its range: the friction that is reported is consistent with its own heat.
/// Gain and time constant stay those of the first fit, without its intervals: the maps share what
/// they do. task: candidates and energy are not read.
Estimate IdentifyOverEnergy(const IdentifierInput& input, MapTask task, const KnownEnergy& known,
                            const MapMaker& maker);

}  // namespace warmjoint::inline identification
