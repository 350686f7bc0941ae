// What the motion of a recording shows.
#pragma once

#include <warmjoint/prepared_log.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace warmjoint {

/// A log that is shorter shows no warming, s.
inline constexpr double kShortestWarming = 180;  // why: joints warm with time constants of minutes

/// What the recording lacks to show friction of that kind, by `check`, with its remedy. Where it
/// lacks nothing, a doubt about the torque column.
std::string WhyNotConverged(const PreparedLog& log, FrictionKind kind);

/// {source, joint, torque_unit, notes[], sampling{samples, duration, step, rate, jitter, gaps,
/// longest_gap}, motion{constant_share, rest_share, segments, holds_speeds, fitted, levels[{velocity, segments,
/// samples}], travel[2], speed_noise, speed_resolution,
/// position_resolution}, faults[], excitation[{what, sufficient,
/// reason}]}, SI.
nlohmann::json CheckToJson(const RecordingCheck& check);

}  // namespace warmjoint
