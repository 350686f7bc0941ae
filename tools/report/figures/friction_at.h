// Friction where a joint is: law, warming and maps together.
#pragma once

#include <vector>

#include "models/friction/friction_description.h"

namespace warmjoint::report {

/// F = Fn(v) + sign(v) E + sum of `maps`, N.m or N. friction: checked.
double FrictionAt(const FrictionDescription& friction, const std::vector<FrictionMap>& maps,
                  const MapPoint<double>& point);

/// The map's axis over that quantity, or nullptr.
const MapAxis* FindAxis(const FrictionMap& map, MapQuantity quantity);

}  // namespace warmjoint::report
