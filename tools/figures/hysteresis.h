// Friction's loop: torque over position, back and forth.
#pragma once

#include <optional>

#include "tools/figures/figure.h"
#include "tools/figures/fit_view.h"

namespace warmjoint::figures {

/// Torque over position in the first and in the last segments of the recording, with the fit: the height
/// of the loop is twice the friction, and what shrinks is its warming. Nothing where the joint moves in
/// one direction alone.
std::optional<Figure> MakeHysteresis(const FitView& view);

}  // namespace warmjoint::figures
