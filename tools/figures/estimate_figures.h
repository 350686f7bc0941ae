// The family of pictures that an estimate gives, and its one list.
#pragma once

#include <optional>
#include <vector>

#include "tools/figures/estimate_view.h"
#include "tools/figures/figure.h"

namespace warmjoint::figures {

using EstimateFigure = NamedFigure<EstimateView>;

/// All pictures: a new one is its own file and one line in estimate_figures.cc.
const std::vector<EstimateFigure>& EstimateFigures();

/// Parameters and RMSE of each iteration, with the final intervals, as in the paper's Fig. 8.
/// Nothing where the identifier did not iterate.
std::optional<Figure> MakeTrace(const Estimate& estimate, const std::string& what);

}  // namespace warmjoint::figures
