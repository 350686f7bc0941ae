// The findings of an examination as data of an inference: names in place of positions.
#pragma once

#include <warmjoint/estimate.h>

#include <vector>

#include "identification/lack_of_fit/examine.h"

namespace warmjoint {

/// One for each finding. unit: of the torque
std::vector<Diagnostic> DiagnosticsOf(const Examination& examination, const Fit& fit,
                                      const std::string& unit);

/// "cold_start" and "open_start" where a start was taken to be cold; "no_slow_drift", "open_drift", "open_curve", "open_memory",
/// "no_dead_band" and "true_clock" where anything was fitted, "angles_in_radians" where a joint turns. unit: of the
/// torque
std::vector<Assumption> AssumptionsOf(const Examination& examination, const Fit& fit,
                                      const std::string& unit);

}  // namespace warmjoint
