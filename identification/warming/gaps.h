// Places where a log does not say how the heat changes, gaps while the joint moves and recordings that may begin warm, and the
// fits that estimate the jump of E there.
#pragma once

#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "identification/warming/thermal_fit.h"

namespace warmjoint {

/// Gaps (GapsOf of models/recording/measurements.h) in order of time; of more than 50 the longest. A joint that
/// is at rest at one place on both sides of a gap rested in it, and a further recording is none.
std::vector<LogGap> FindGaps(const LogSamples& measurements);

/// Starts of all recordings but the first, as gaps of infinite length: after them E is what it then is, and no longer
/// depends on what was before.
std::vector<LogGap> FurtherStarts(const LogSamples& measurements);

/// The starts whose E(0) a fit has to estimate. There are none where E(0) is given or expected; else they are those of the
/// recordings that keep samples, since the others show nothing of their E(0).
std::vector<LogGap> FreeStarts(const InitialEnergy& initial, const LogSamples& measurements,
                               const Selection& kept);
inline bool IsStart(const LogGap& gap) { return std::isinf(gap.length); }

/// Both in order of time.
std::vector<LogGap> Merged(const std::vector<LogGap>& one, const std::vector<LogGap>& other);

/// How far the energy after each gap may lie from what a filter takes it for, which holds the last
/// loss: by |E| of the warmest moment, (1 - exp(-gap/tau)) of it; at a start without bound. [J] N.m or N; warmest: N.m or
/// N.
Eigen::VectorXd JumpSpread(const std::vector<LogGap>& gaps, double warmest, double time_constant);

/// Names of the jumps in a table of parameters: energy_jump_1, ... at gaps, initial_energy_2, ... of further recordings. [J]
std::vector<std::string> JumpNames(const std::vector<LogGap>& gaps, const LogSamples& measurements);

/// LogGap::behind of each. [J]
std::vector<Eigen::Index> Behind(const std::vector<LogGap>& gaps);

/// Fits once more, the jumps of E at gaps too; from a fit without them, which it replaces. A fit that does not model a
/// gap may take it for a warm start that cools. So where E(0) is free, the jumps are found with a cold start as well, and
/// E(0) after them; of both fits the one is taken that leaves less.
/// rows: without gaps; gaps: with the further starts that are free in `rows`; scanned: where the fit began. Returns how
/// large the jumps may be. [J]
Eigen::VectorXd FitJumps(const ThermalRows& rows, const std::vector<LogGap>& gaps,
                         const InitialGuess& scanned, ThermalFit& fit);

/// Fits once more where E(0) was expected, by the noise that the fit leaves: in the fit before it there was no
/// estimate of the noise by which to weigh the expectation. Where the log contradicts what was expected (ContradictsExpected),
/// E(0) is estimated from the log alone. fit: takes the place of the one given. deviation: of E(0) in a fit that knows
/// nothing of it, N.m or N. Returns the clause that reports a contradiction, else an empty text.
std::string RefitStart(const ThermalRows& rows,
                       const std::function<double(const ThermalFit&)>& deviation, ThermalFit& fit);

}  // namespace warmjoint
