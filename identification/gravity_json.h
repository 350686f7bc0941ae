// Gravity along a joint as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "identification/gravity.h"
#include "models/foundation/bad_input.h"

namespace warmjoint::inline identification {

/// {kind, sine, cosine}, {kind, position[] (rad), torque[]} or {kind, offset}.
nlohmann::json GravityToJson(const GravityModel& gravity);

/// The inverse. Throws BadInput from `place`.
GravityModel GravityFromJson(const nlohmann::json& json, const Place& place);

}  // namespace warmjoint::inline identification
