// Maps of friction as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "models/foundation/bad_input.h"
#include "models/friction/friction_map.h"

namespace warmjoint::inline models {

/// {axes: [{quantity, centres, width, period?, sides: together|apart}], kernels: normalised|plain,
/// factor: one|direction|velocity, weights: [...]}.
nlohmann::json MapToJson(const FrictionMap& map);

/// The inverse; checked.
FrictionMap MapFromJson(const nlohmann::json& json, const Place& place);

}  // namespace warmjoint::inline models
