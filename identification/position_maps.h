// Maps over position, as options describe them.
#pragma once

#include "identification/map_options.h"

namespace warmjoint {

/// basis, kernels, velocity_kernels.
std::vector<OptionInfo> PositionMapOptions();

/// What the option `position` takes, for identifiers that can do without a map.
struct PositionPart {
  std::string default_value;
  std::string allowed;
  std::string meaning;
};

/// law, position, and what says how the map is made.
std::vector<OptionInfo> PositionPartOptions(const PositionPart& position);

/// `count` kernels over position for each of `speeds` bins of either direction of motion; alike in
/// both directions where there are none. points: [n x 5] kept; width: in spacings.
FrictionMap PositionMap(const MapPoints& points, KernelKind kernels, int count, double width,
                        int speeds = 1);

/// The shapes to choose from: every number of kernels with every width. points: [n x 5] kept.
std::vector<std::vector<FrictionMap>> PositionMaps(const Options& options,
                                                   const MapSettings& settings,
                                                   const MapPoints& points);

}  // namespace warmjoint
