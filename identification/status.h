// Whether an answer can be trusted.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "models/foundation/field.h"

namespace warmjoint::inline identification {

/// Whether the numbers can be trusted, and if not, why.
enum class Status { ok, not_converged, not_identifiable, inadequate_model, bad_data };

inline std::span<const Word<Status>> WordsOf(Status) {
  static constexpr std::array words{
      Word{"ok", Status::ok}, Word{"not_converged", Status::not_converged},
      Word{"not_identifiable", Status::not_identifiable},
      Word{"inadequate_model", Status::inadequate_model}, Word{"bad_data", Status::bad_data}};
  return words;
}

/// "ok", "not_converged", ...
inline std::string_view StatusName(Status status) { return NameOf(status); }

}  // namespace warmjoint::inline identification
