// What code must know of a law beyond its table.
#pragma once

#include <warmjoint/friction.h>

#include <optional>
#include <string_view>

namespace warmjoint {

/// What the parameter of that name is in the laws that have it, for what was read from a file;
/// LawPart::other where none has.
LawPart PartOf(std::string_view name);

/// The place in the law's table of the first parameter that is that part; nothing where there is
/// none.
std::optional<size_t> PlaceOf(LawPart part, const Law& law);

/// Row of the regressor at velocity v: dF/dp, one entry for each parameter.
/// Exact for laws that are linear in their parameters: the force for each unit vector.
void Regressor(const Law& law, double v, double* row);

}  // namespace warmjoint
