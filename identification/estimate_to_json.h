// An estimate as a file holds it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "identification/estimate.h"

namespace warmjoint::inline identification {

/// The estimate as JSON: {identifier, options{name: text}, status, message, parameters{name: {value, unit, std,
/// interval95}}, metrics{}, holdout{}, without_holdout, trace[{iteration, rmse, parameters{}}], friction{},
/// gravity{}, warnings[], friction_at_speeds[{speed, speed_unit, value, unit, std, interval95}], bands[{quantities[], points[][], value[], std[], interval95[][]}],
/// state_end{time: {value, unit, std, interval95}, energy, second_energy}, temperature{name: as of parameters}, choice{chosen, reason, blocks,
/// trials[{name, rmse, parameters, dropped}]}, covariance{parameters[], matrix[][]}, diagnostics[{test, made, reason, statistic, p, p_adjusted,
/// rejected, effect{value, unit}, moves{}}], assumptions[{name, meaning, moves{}}]};
/// message is the full one, and `warnings` repeats its last clauses where there are any; bands only
/// where maps are, friction_at_speeds where they share a constant with the law. What is absent, or is not a finite number, is null.
nlohmann::json EstimateToJson(const Estimate& estimate);

}  // namespace warmjoint::inline identification
