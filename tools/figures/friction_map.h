// Friction over angle and speed as a heat-map.
#pragma once

#include <optional>

#include "tools/figures/figure.h"
#include "tools/figures/fit_view.h"

namespace warmjoint::figures {

/// sign(v) F over motor angle (or joint position, where the maps have that) and velocity, cold and
/// at the warmest of the recording, on one colour scale. Nothing without maps over an angle.
std::optional<Figure> MakeFrictionMap(const FitView& view);

}  // namespace warmjoint::figures
