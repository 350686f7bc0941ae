// Members of JSON objects that people write, checked.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "models/foundation/bad_input.h"

namespace warmjoint::inline models {

/// Refuses what is no object, and keys that are not `known`, with the nearest. what: the object,
/// for messages.
void RefuseUnknownKeys(const nlohmann::json& object, std::string_view what,
                       const std::vector<std::string>& known, const Place& place);

/// The number that `value` is. what: its name, for messages.
double NumberFrom(const nlohmann::json& value, std::string_view what, const Place& place);

}  // namespace warmjoint::inline models
