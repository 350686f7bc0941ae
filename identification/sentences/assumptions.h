// Of what an answer takes for granted, since no test can see it.
#pragma once

#include <warmjoint/diagnostics.h>

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "identification/fit/cause.h"
#include "identification/fit/fit.h"

namespace warmjoint {

/// "cold_start" and "open_start" where a start was taken to be cold; "no_slow_drift", "open_drift", "open_curve", "open_memory",
/// "no_dead_band" and "true_clock" where anything was fitted, "angles_in_radians" where a joint turns. unit: of the
/// torque
std::vector<Assumption> AssumptionsOf(const std::vector<Cause>& causes, const Fit& fit,
                                      const std::string& unit);

/// Changes of a row's parameters by their names.
ParameterMoves NamedMoves(const std::vector<std::size_t>& rows, const Eigen::VectorXd& moves,
                          const Fit& fit);

}  // namespace warmjoint
