// Where a log does not say what becomes of the heat: gaps while the joint moves, and recordings that may begin warm.
#pragma once

#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <cmath>
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

/// Those that a fit has to find: none where E(0) is not open; else of the recordings that keep samples, since the others
/// tell nothing of theirs.
std::vector<LogGap> FreeStarts(const InitialEnergy& initial, const LogSamples& measurements,
                               const Selection& kept);
inline bool IsStart(const LogGap& gap) { return std::isinf(gap.length); }

/// Both in order of time.
std::vector<LogGap> Merged(const std::vector<LogGap>& one, const std::vector<LogGap>& other);

/// How far the energy behind each gap may lie from what a filter takes it for, which holds the last
/// loss: by |E| of the warmest moment, (1 - exp(-gap/tau)) of it; at a start without bound. [J] N.m or N; warmest: N.m or
/// N.
Eigen::VectorXd JumpSpread(const std::vector<LogGap>& gaps, double warmest, double time_constant);

/// Names of the jumps in a table of parameters: energy_jump_1, ... at gaps, initial_energy_2, ... of further recordings. [J]
std::vector<std::string> JumpNames(const std::vector<LogGap>& gaps, const LogSamples& measurements);

/// LogGap::behind of each. [J]
std::vector<Eigen::Index> Behind(const std::vector<LogGap>& gaps);

}  // namespace warmjoint
