// Maps over position, as options describe them.
#pragma once

#include "identification/maps/map_options.h"

namespace warmjoint::inline identification {

/// basis, kernels, velocity_kernels.
std::vector<OptionInfo> PositionMapOptions();

/// position, and what says how the map is made: for identifiers that can do without, which `none`, the
/// default, says. allowed, meaning: of the option position.
std::vector<OptionInfo> PositionPartOptions(const std::string& allowed, const std::string& meaning);

/// `count` kernels over position for each of `speeds` bins of either direction of motion; alike in
/// both directions where there are none. points: [n x 5] kept; width: in spacings.
FrictionMap PositionMap(const MapPoints& points, KernelKind kernels, int count, double width,
                        int speeds = 1);

/// The shapes to choose from: every number of kernels with every width. points: [n x 5] kept.
std::vector<std::vector<FrictionMap>> PositionMaps(const Options& options,
                                                   const MapSettings& settings,
                                                   const MapPoints& points);

}  // namespace warmjoint::inline identification
