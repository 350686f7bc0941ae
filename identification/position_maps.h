// Maps over position, as options describe them.
#pragma once

#include "identification/map_options.h"

namespace warmjoint {

/// basis, kernels, velocity_kernels.
std::vector<OptionInfo> PositionMapOptions();

/// law, position=none|map, and what says how the map is made: for identifiers that can do without.
std::vector<OptionInfo> PositionPartOptions();

/// The shapes to choose from: every number of kernels with every width. points: [n x 5] kept.
std::vector<std::vector<FrictionMap>> PositionMaps(const Options& options,
                                                   const MapSettings& settings,
                                                   const MapPoints& points);

}  // namespace warmjoint
