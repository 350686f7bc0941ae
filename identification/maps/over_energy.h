// Maps over the energy, once it is known.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "identification/maps/identify_maps.h"

namespace warmjoint {

/// Shapes of maps for points whose energy is known. points: [n x 5] kept.
using MapMaker = std::function<std::vector<std::vector<FrictionMap>>(const MapPoints& points)>;

/// F = Fn(v) + sign(v) E + maps over E and other quantities. E comes from a first fit whose friction
/// warms, with its start and its jumps; law and maps are fitted to what it leaves of the torque; then the whole friction
/// predicts E anew, until E rests to 1e-4 of its range: the friction of the fit is consistent with
/// its own heat. Gain and time constant stay those of `warm`, without intervals: the maps share what
/// they do. Where `warm` is null nothing warms. task: candidates and energy are not read.
Fit IdentifyOverEnergy(const IdentifierInput& input, MapTask task, const Fit* warm,
                       const MapMaker& maker);

}  // namespace warmjoint
