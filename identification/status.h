// Whether an answer can be trusted.
#pragma once

#include <array>
#include <string_view>

namespace warmjoint::inline identification {

/// Whether the numbers can be trusted, and if not, why.
enum class Status { ok, not_converged, not_identifiable, inadequate_model, bad_data };

/// All of them.
inline constexpr std::array kStatuses{Status::ok, Status::not_converged, Status::not_identifiable,
                                      Status::inadequate_model, Status::bad_data};

/// "ok", "not_converged", ...
constexpr std::string_view StatusName(Status status) {
  switch (status) {
    case Status::ok:
      return "ok";
    case Status::not_converged:
      return "not_converged";
    case Status::not_identifiable:
      return "not_identifiable";
    case Status::inadequate_model:
      return "inadequate_model";
    case Status::bad_data:
      break;
  }
  return "bad_data";
}

}  // namespace warmjoint::inline identification
