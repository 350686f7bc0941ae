// A recording as it was logged.
#pragma once

#include "tools/report/draw/figure.h"
#include "tools/report/figures/fit_view.h"

namespace warmjoint::report {

/// Position, velocity and torque over time, with the samples in colour that are kept for the fit.
Figure MakeLogFigure(const FitView& view);

}  // namespace warmjoint::report
