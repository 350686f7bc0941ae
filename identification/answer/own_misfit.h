// Whether an estimate that another program made fits its own log.
#pragma once

#include <optional>
#include <string>

#include "identification/inference/inference.h"
#include "identification/lack_of_fit/judging.h"

namespace warmjoint {

/// The tests for lack of fit ask for what a law cannot follow; a least-squares fit leaves nothing that
/// its law could. Another program's may: one Gauss-Newton step d of its parameters, over its residual,
/// says what the same law would take up. Returns a sentence where J d is relevant (judging) and a part
/// of d is beyond noise: of p parameters, at an error level of 1 % for all (Bonferroni). inference: of
/// the fit; selection: samples at constant speed.
std::optional<std::string> OwnMisfit(const Fit& fit, const Inference& inference,
                                     const Measurements& measurements, const Selection& selection,
                                     const Judging& judging);

}  // namespace warmjoint
