// One joint's friction as plain data: what a friction file holds, and what estimates, scenarios,
// the plugin and `attach` exchange.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "models/foundation/bad_input.h"
#include "models/friction/friction_map.h"
#include "models/friction/law.h"
#include "models/friction/thermal.h"

namespace warmjoint {

/// A nominal law with its values, and optionally its warming and maps:
/// F = Fn(v) + sign(v) E + sum of the maps.
struct FrictionDescription {
  std::string law = "viscous_coulomb";
  std::map<std::string, double> parameters;  // SI; one for each of the law's table
  std::optional<Thermal> thermal;
  double ambient = 0;  // ambient temperature, degC; not used by the energy state
  double gear = 1;     // motor turns for each joint turn (rotary), rad of motor per m (linear)
  std::vector<FrictionMap> maps{};  // friction that depends on position, energy, load
};

/// Gives the parameters that may be left out their defaults, where they are missing.
void FillDefaults(FrictionDescription& friction);

/// Checks names and bounds against the parameter tables; throws BadInput from `place`.
void CheckFriction(const FrictionDescription& friction, const Place& place);

/// The law's parameter values in the order of its table. The description must have been checked.
std::vector<double> LawValues(const FrictionDescription& friction);

/// {law, parameters{}, thermal{thermal_gain, thermal_time_constant, ambient}, gear, maps[]}.
nlohmann::json FrictionToJson(const FrictionDescription& friction);

/// The inverse; checked. Unknown keys, missing parameters and wrong types throw BadInput.
FrictionDescription FrictionFromJson(const nlohmann::json& json, const Place& place);

/// Reads a friction file: an object with a `friction` member (as in estimate.json) or that member
/// by itself. Throws BadInput.
FrictionDescription ReadFrictionFile(const std::string& path);

}  // namespace warmjoint
