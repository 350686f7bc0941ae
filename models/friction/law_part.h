// What of its law's force a parameter is.
#pragma once

#include <optional>
#include <string_view>

#include "models/friction/law.h"

namespace warmjoint::inline models {

/// For code that must tell one parameter from another, whatever the law. A law has at most one of
/// each, but for a level to each direction.
enum class LawPart {
  other,
  slope,       // over speed
  level,       // while it slides
  rest_level,  // at rest
  rest_rise,   // of the level at rest over that while it slides
  bristle,     // stiffness of the law's own
};

/// What the parameter of that name is in the laws that have it; LawPart::other where none has.
LawPart PartOf(std::string_view name);

/// The place in the law's table of the first parameter that is that part; nothing where there is
/// none.
std::optional<size_t> PlaceOf(LawPart part, const Law& law);

}  // namespace warmjoint::inline models
