// Of the log: its faults, its noise and steps, and what it is too short or too coarse for.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/prepared_log.h>

#include <string>
#include <string_view>
#include <vector>

#include "identification/inference/cause.h"
#include "identification/sentences/moved_parameter.h"

namespace warmjoint {

/// Of faults (log_faults.h).
std::string ExplainFaults(const std::vector<std::string>& faults);
inline constexpr const char* kSlopesOverSpeed = "slopes over speed";  // of maps
/// Of a velocity that was averaged over each segment, and of what that left of its noise. slope: what slopes over speed; empty: nothing.
std::string ExplainAveraging(const VelocityNoise& taken, JointKind joint, std::string_view slope);
std::string ExplainVelocityNoise(const VelocityNoise& taken, std::string_view slope);
/// Of reversals between two samples. unseen: share of the path
std::string ExplainReversals(double unseen);
/// Of a torque in steps, whose effect was taken off (shift) or hides. step: in `unit`
std::string ExplainRounding(double step, const std::string& unit, const MovedParameter& moved,
                            Action action);

/// Of a fit to few samples. motion: of the fit
std::string ExplainFewSamples(double used, double moving, double fewest, double least_share,
                              MotionKind motion);
/// Of a law's levels, by their names, where the log moves at one speed each way. speeds: rad/s or m/s, in `unit`
std::string ExplainOneSpeed(const std::vector<std::string>& names,
                            const std::vector<double>& speeds, const std::string& unit);

}  // namespace warmjoint
