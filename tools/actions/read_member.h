// Reads a member of an estimate file.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "models/foundation/bad_input.h"

namespace warmjoint::inline tools {

/// What `read` makes of the member. name: of it; place: of the file; remedy: what ends the refusal. Throws BadInput
/// from `place` where something is missing there or has another type.
template <typename Read>
auto ReadMember(std::string_view name, const Place& place, std::string_view remedy,
                const Read& read) {
  try {
    return read();
  } catch (const nlohmann::json::exception& error) {
    Refuse(place, "its member `{}` cannot be read ({}){}", name, error.what(), remedy);
  }
}

}  // namespace warmjoint::inline tools
