// What a fit of law and heat is refined by, from where it ended: its start, and gaps of the log.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "identification/warming/gaps.h"
#include "identification/warming/thermal_fit.h"

namespace warmjoint {

/// Fits once more, the jumps of E at gaps too; from a fit without them, whose place it takes. A gap that a fit does
/// not know may pass for a warm start that cools: where E(0) is free, the jumps are found beside a cold start as well,
/// E(0) after them, and of both fits the one is taken that leaves less.
/// rows: without gaps; gaps: with the further starts that are free in `rows`; scanned: where the fit began. Returns how
/// far the jumps may be. [J]
Eigen::VectorXd FitJumps(const ThermalRows& rows, const std::vector<LogGap>& gaps,
                         const InitialGuess& scanned, ThermalFit& fit);

/// Fits once more where E(0) was expected, by the noise that the fit leaves: the fit before it knew no
/// noise to weigh the expectation by. Where the log contradicts what was expected (ContradictsExpected), E(0) is
/// estimated from the log alone. fit: takes the place of the one given. deviation: of E(0) in a fit that knows
/// nothing of it, N.m or N. Returns the clause that tells of a contradiction, else an empty text.
std::string RefitStart(const ThermalRows& rows,
                       const std::function<double(const ThermalFit&)>& deviation, ThermalFit& fit);

}  // namespace warmjoint
