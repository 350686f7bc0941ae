// Of a torque that is late against the motion: its delay, its lag, and how long it takes to settle.
#pragma once

#include <string>
#include <string_view>

namespace warmjoint {

// why a lag is not estimated
inline constexpr const char* kLagInAnyMotion =
    "torque_lag is told by segments of constant speed, which a fit of any motion does not look at; "
    "use motion constant, or torque_lag none";
inline constexpr const char* kLagUnderHuber =
    "torque_lag is estimated by least squares; use loss squares, or torque_lag none";
inline constexpr const char* kLagBesideMaps =
    "torque_lag is estimated with a law without maps; use position none, or torque_lag none";
inline constexpr const char* kNoLagSeen = "the torque shows no lag, so that none is fitted";

/// The sentence about a torque that is late, s; below 0: early. step: of the log, s
std::string ExplainDelay(double delay, double step);
/// The sentence about a delay that the log does not show clearly, which intervals cover.
std::string ExplainUntoldDelay(double delay, double step);
/// The sentence about a delay that a fit leaves out. harm: the share by which that changes the friction
std::string ExplainDelayLeftOut(double delay, double step, double harm,
                                std::string_view identifier);

/// The sentence about samples left out because the torque lags, s.
std::string ExplainLeftOutByLag(double lag);
/// The sentence about samples left out since the torque takes time to settle after a change of speed. settling: that time, s
std::string ExplainSettling(double settling);

}  // namespace warmjoint
