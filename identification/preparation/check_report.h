// A recording's check as text and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "identification/preparation/check.h"

namespace warmjoint::inline identification {

/// Lines for people: sampling, motion, speeds in each direction, faults, and what can be
/// identified.
std::string CheckToText(const RecordingCheck& check);

/// {source, joint, torque_unit, notes[], sampling{samples, duration, step, rate, jitter, gaps,
/// longest_gap}, motion{constant_share, rest_share, segments, levels[{velocity, segments,
/// samples}], travel[2], speed_noise, speed_resolution,
/// position_resolution}, faults[], excitation[{what, sufficient,
/// reason}]}, SI.
nlohmann::json CheckToJson(const RecordingCheck& check);

}  // namespace warmjoint::inline identification
