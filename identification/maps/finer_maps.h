// The same maps with twice the kernels.
#pragma once

#include <vector>

#include "models/friction/friction_map.h"

namespace warmjoint::inline identification {

/// Maps with twice the kernels, at most kMostMapCentres, along their first axis, where that is a position, over the same range and
/// as wide in spacings of their centres; all others stay. Weights are not set.
std::vector<FrictionMap> TwiceAsFine(std::vector<FrictionMap> maps);

}  // namespace warmjoint::inline identification
