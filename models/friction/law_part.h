// Finding what of its law's force a parameter is.
#pragma once

#include <optional>
#include <string_view>

#include "models/friction/law.h"

namespace warmjoint::inline models {

/// What the parameter of that name is in the laws that have it, for what was read from a file;
/// LawPart::other where none has.
LawPart PartOf(std::string_view name);

/// The place in the law's table of the first parameter that is that part; nothing where there is
/// none.
std::optional<size_t> PlaceOf(LawPart part, const Law& law);

}  // namespace warmjoint::inline models
