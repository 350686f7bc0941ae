// The parameters of an estimate by what they are; their names are those of the fit's rows.
#pragma once

#include <string>
#include <string_view>

#include "identification/estimate.h"
#include "identification/fit.h"
#include "models/friction/law_part.h"

namespace warmjoint::inline identification {

inline constexpr std::string_view kInertiaName = "inertia", kTorqueLagName = "torque_lag";

/// The name of the which-th row with a role, of those whose names depend neither on the law nor on the
/// kind of gravity: heat (gain, time constant), start, jump, inertia and lag.
std::string NameOf(Role role, int which = 0);

/// The which-th parameter with such a role, or nullptr.
const EstimatedParameter* Find(Role role, const Estimate& estimate, int which = 0);

/// The first parameter that is that part of a law's force, or nullptr.
const EstimatedParameter* Find(LawPart part, const Estimate& estimate);

}  // namespace warmjoint::inline identification
