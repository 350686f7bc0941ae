// Friction files: one joint's friction as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "models/foundation/node.h"
#include "models/friction/friction_description.h"

namespace warmjoint::inline models {

/// {law, parameters{}, gear, thermal{thermal_gain, thermal_time_constant, ambient, second{thermal_gain,
/// thermal_time_constant}}, level_per_temperature, viscous_per_energy, load_gain, torque_unit, maps[]};
/// what is at its default is left out.
Tree FrictionToTree(const FrictionDescription& friction);
/// The inverse; checked. Unknown keys, missing parameters and wrong types throw BadInput.
FrictionDescription FrictionFrom(const Node& node);
void ReadValue(const Node& node, FrictionDescription* value, const FieldInfo& info);

/// A list of maps, each {axes[{quantity, centres[], width, period, sides}], kernels, factor, weights[]}.
Tree MapsToTree(const std::vector<FrictionMap>& maps);

/// The inverse; checked. Throws BadInput.
std::vector<FrictionMap> MapsFrom(const Node& node);

/// Throws BadInput where a friction is in amperes, which no simulator can use.
void RefuseAmperes(const FrictionDescription& friction, const Place& place);

/// Reads a friction file: an object with a `friction` member (as in estimate.json) or that member
/// by itself. Throws BadInput, of a friction in amperes too.
FrictionDescription ReadFrictionFile(const std::string& path);

}  // namespace warmjoint::inline models
