// Gaps of a log while the joint moves: what it loses in them is not known.
#pragma once

#include <warmjoint/recording.h>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace warmjoint {

/// Gaps (GapsOf of models/recording/measurements.h) in order of time; of more than 50 the longest. A joint that
/// is at rest at one place on both sides of a gap rested in it, and one that is cold after it
/// (Measurements::starts) keeps nothing of it: neither counts.
std::vector<LogGap> FindGaps(const Measurements& measurements);

/// How far the energy behind each gap may lie from what a filter takes it for, which holds the last
/// loss: by |E| of the warmest moment, (1 - exp(-gap/tau)) of it. [J] N.m or N; warmest: N.m or N.
Eigen::VectorXd JumpSpread(const std::vector<LogGap>& gaps, double warmest, double time_constant);

/// LogGap::behind of each. [J]
std::vector<Eigen::Index> Behind(const std::vector<LogGap>& gaps);

/// "a gap of 100 s at 300 s", "5 gaps of up to 60 s, the first at 300 s".
std::string DescribeGaps(const std::vector<LogGap>& gaps, const Measurements& measurements);

/// The warning that jumps of E are estimated at them.
std::string LossesInGaps(const std::vector<LogGap>& gaps, const Measurements& measurements);

}  // namespace warmjoint
