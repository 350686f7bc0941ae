// A recording as it was logged.
#pragma once

#include "tools/figures/figure.h"
#include "tools/figures/fit_view.h"

namespace warmjoint::figures {

/// Position, velocity and torque over time, with the samples in colour that are kept for the fit.
Figure MakeLogFigure(const FitView& view);

}  // namespace warmjoint::figures
