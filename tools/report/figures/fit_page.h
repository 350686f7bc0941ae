// The story of one recording on one page.
#pragma once

#include "tools/report/draw/figure.h"
#include "tools/report/figures/fit_view.h"

namespace warmjoint::report {

/// Verdict and parameters, data with fit, cold and warm close-ups, friction over speed, warm-up,
/// evidence of the residuals. Without a fit: what the data look like and why there is none.
Figure MakeFitPage(const FitView& view);

}  // namespace warmjoint::report
