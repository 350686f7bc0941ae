// Of the log: its faults, its noise and steps, and what it is too short or too coarse for.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/prepared_log.h>

#include <string>
#include <string_view>
#include <vector>

#include "identification/fit/cause.h"
#include "identification/sentences/moved_parameter.h"

namespace warmjoint {

/// The sentence about faults (log_faults.h).
std::string ExplainFaults(const std::vector<std::string>& faults);
inline constexpr const char* kSlopesOverSpeed = "slopes over speed";  // of maps
/// The sentence about a velocity that was averaged over each segment; the next is about what that left of its noise. slope: the
/// name of what has a slope over speed; empty: nothing
std::string ExplainAveraging(const VelocityNoise& taken, JointKind joint, std::string_view slope);
std::string ExplainVelocityNoise(const VelocityNoise& taken, std::string_view slope);
/// The sentence about reversals between two samples. unseen: share of the path
std::string ExplainReversals(double unseen);
/// The sentence about a torque in steps, whose effect was subtracted (shift) or is hidden. step: in `unit`
std::string ExplainRounding(double step, const std::string& unit, const MovedParameter& moved,
                            Action action);

/// The sentence about a fit to few samples. motion: of the fit; chosen: of a fit that has no other
std::string ExplainFewSamples(double used, double moving, double fewest, double least_share,
                              MotionKind motion);
/// The sentence about a law's levels, by their names, where the joint moves at one speed each way. speeds: rad/s or m/s, in `unit`
std::string ExplainOneSpeed(const std::vector<std::string>& names,
                            const std::vector<double>& speeds, const std::string& unit);

}  // namespace warmjoint
