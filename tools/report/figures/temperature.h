// The heat of the fit beside the temperature that the recording holds.
#pragma once

#include <optional>

#include "tools/report/figures/fit_view.h"

namespace warmjoint::report {

/// E and the temperature over time, and one over the other, with the line of
/// identification/report/heat_beside_temperature.h. Nothing where the estimate has none.
std::optional<Figure> MakeTemperature(const FitView& view);

}  // namespace warmjoint::report
