// The parameters of an estimate by what they are; their names are those of the fit's rows.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/friction.h>

#include <optional>

#include "identification/fit.h"

namespace warmjoint {

/// The which-th parameter with such a role, or nullptr.
const EstimatedParameter* Find(Role role, const Estimate& estimate, int which = 0);

/// Its value, where the estimate has it.
std::optional<double> ValueOf(Role role, const Estimate& estimate);

/// The first parameter that is that part of a law's force, or nullptr.
const EstimatedParameter* Find(LawPart part, const Estimate& estimate);

}  // namespace warmjoint
