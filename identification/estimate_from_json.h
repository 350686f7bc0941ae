// An estimate read from a file.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "identification/estimate.h"
#include "models/foundation/bad_input.h"

namespace warmjoint::inline identification {

/// The inverse of EstimateToJson: null numbers become NaN, parameters come sorted by name. Throws BadInput from
/// `place` for a missing member, a wrong type or an unknown status.
Estimate EstimateFromJson(const nlohmann::json& json, const Place& place);

}  // namespace warmjoint::inline identification
