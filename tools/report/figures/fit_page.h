// The story of one recording on one page.
#pragma once

#include <string>

#include "tools/report/draw/figure.h"
#include "tools/report/figures/fit_view.h"

namespace warmjoint::report {

/// Verdict and parameters, data with fit, cold and warm close-ups, friction over speed, warm-up,
/// evidence of the residuals. Without a fit: what the data look like and why there is none.
Figure MakeFitPage(const FitView& view);

/// Draws the page into a file, PNG, SVG or PDF by its end. Throws BadInput for another end, and
/// where the folder cannot be written.
void WriteFitPage(const PreparedLog& log, const Estimate& estimate, const std::string& path);

}  // namespace warmjoint::report
