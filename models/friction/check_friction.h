// Whether one joint's friction makes sense.
#pragma once

#include "models/foundation/bad_input.h"
#include "models/friction/friction_description.h"

namespace warmjoint::inline models {

/// Refuses, from `place`, sizes that do not fit, widths or periods that are not positive, centres
/// that do not ascend, an axis with its sides apart that has a centre at 0, numbers not finite.
void CheckMap(const FrictionMap& map, const Place& place);

/// Checks names and bounds against the parameter tables, and that all parts make sense together:
///   static >= coulomb; what depends on E needs thermal; viscous_per_energy needs a law with a
///   slope, and a slope that falls as the joint warms; maps over motor_position lie on the circle.
/// Throws BadInput from `place`.
void CheckFriction(const FrictionDescription& friction, const Place& place);

}  // namespace warmjoint::inline models
