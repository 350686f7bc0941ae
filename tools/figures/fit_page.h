// The story of one recording on one page.
#pragma once

#include "tools/figures/figure.h"
#include "tools/figures/fit_view.h"

namespace warmjoint::figures {

/// Verdict and parameters, data with fit, cold and warm close-ups, friction over speed, warm-up,
/// evidence of the residuals. Without a fit: what the data look like and why there is none.
Figure MakeFitPage(const FitView& view);

}  // namespace warmjoint::figures
