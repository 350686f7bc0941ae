// Whether one joint's friction makes sense.
#pragma once

#include <warmjoint/friction.h>

#include "models/foundation/bad_input.h"

namespace warmjoint {

/// Refuses, from `place`, sizes that do not fit, widths or periods that are not positive, centres
/// that do not ascend, an axis with its sides apart that has a centre at 0, numbers not finite.
void CheckMap(const FrictionMap& map, const Place& place);

/// The same as CheckFriction of the public header, refusing from `place`.
void CheckFriction(const Friction& friction, const Place& place);

/// With what was left out at its default (FillDefaults), then checked.
Friction Completed(Friction friction, const Place& place);

}  // namespace warmjoint
