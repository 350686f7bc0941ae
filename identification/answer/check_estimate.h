// The verdict on an estimate that another program made.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/prepared_log.h>

#include "identification/lack_of_fit/find_lack_of_fit.h"

namespace warmjoint {

/// Judges an estimate by its friction along the log, as FitAndCheck judges the fits of our own
/// identifiers (lack_of_fit/find_lack_of_fit.h): status, message, warnings, intervals, diagnostics and
/// assumptions become those of the verdict. Where the model is inadequate, intervals and friction
/// are removed; so they are where its own law could follow the log better (OwnLawCause). An estimate that is not ok, or without
/// a friction, is kept as it is, and its diagnostics say that no test was made.
void CheckEstimate(const PreparedLog& log, const LackOfFitSettings& judging, Estimate& estimate);

}  // namespace warmjoint
