// Several estimates in one picture.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/figures/estimate_view.h"
#include "tools/figures/figure.h"

namespace warmjoint::figures {

/// An estimate under the name that it has in the picture.
using NamedEstimate = std::pair<std::string, EstimateView>;

/// Friction over velocity of each, cold, over the samples of the first, and E over time of those that
/// warm. Nothing where fewer than two have a friction and a recording.
std::optional<Figure> MakeOverlay(const std::vector<NamedEstimate>& estimates);

}  // namespace warmjoint::figures
