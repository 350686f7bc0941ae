// What an estimate says of a recording against what was measured.
#pragma once

#include <optional>

#include "tools/figures/figure.h"
#include "tools/figures/fit_view.h"

namespace warmjoint::figures {

/// Predicted over measured torque at the kept samples with the line of equality, and the residuals
/// over the predicted torque. With another recording than the one that was fitted, this shows how the
/// estimate carries over. Nothing without a fit.
std::optional<Figure> MakePredicted(const FitView& view);

/// The same of samples that the fit has not seen, the only ones that `view` keeps.
std::optional<Figure> MakeHeldOut(const FitView& view);

}  // namespace warmjoint::figures
