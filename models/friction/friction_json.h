// One joint's friction as JSON, and whether it makes sense.
#pragma once

#include <warmjoint/friction.h>

#include <vector>

#include "models/foundation/bad_input.h"
#include "models/foundation/node.h"

namespace warmjoint {

/// {law, parameters{}, gear, thermal{thermal_gain, thermal_time_constant, ambient, second{thermal_gain,
/// thermal_time_constant}}, level_per_temperature, viscous_per_energy, load_gain, torque_unit, maps[]};
/// what is at its default is left out.
Tree FrictionToTree(const Friction& friction);
/// The inverse; checked. Unknown keys, missing parameters and wrong types throw BadInput.
Friction FrictionFrom(const Node& node);

/// Of a list of maps, each {axes[{quantity, centres[], width, period, sides}], kernels, factor, weights[]}; checked. Throws
/// BadInput.
std::vector<FrictionMap> MapsFrom(const Node& node);

/// Throws BadInput where a friction is in amperes, which no simulator can use.
void RefuseAmperes(const Friction& friction, const Place& place);

/// Refuses, from `place`, sizes that do not fit, widths or periods that are not positive, centres
/// that do not ascend, an axis with its sides apart that has a centre at 0, numbers not finite.
void CheckMap(const FrictionMap& map, const Place& place);

/// The same as CheckFriction of the public header, refusing from `place`.
void CheckFriction(const Friction& friction, const Place& place);

/// With what was left out at its default (FillDefaults), then checked.
Friction Completed(Friction friction, const Place& place);

}  // namespace warmjoint
