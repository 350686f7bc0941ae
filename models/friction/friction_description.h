// One joint's friction as plain data: what a friction file holds, and what estimates, scenarios,
// the plugin and `attach` exchange.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "models/foundation/bad_input.h"
#include "models/friction/friction_map.h"
#include "models/friction/law.h"
#include "models/friction/thermal.h"

namespace warmjoint::inline models {

/// A nominal law with its values, and optionally its warming, load and maps:
///   F = (kv + b E) v + sign(v) (g + E + c |load|) + sum of the maps
/// with g the law's level, E = E1 + E2 the heat (thermal.h), b viscous_per_energy, c load_gain.
struct FrictionDescription {
  std::string law = "viscous_coulomb";
  std::map<std::string, double> parameters;  // SI; one for each of the law's table
  std::optional<Thermal> thermal;
  double ambient = 0;  // temperature at which the law's parameters hold, degC
  double gear = 1;     // motor turns for each joint turn (rotary), rad of motor per m (linear)
  std::vector<FrictionMap> maps{};          // friction that depends on position, energy, load
  std::optional<Thermal> second_thermal{};  // a second stage of warming, fed by the same loss
  double level_per_temperature = 0;         // of the temperature form, N.m/K or N/K; 0: none
  double viscous_per_energy = 0;            // b of Eq. (27), s/rad or s/m
  double load_gain = 0;                     // c, level for each unit of |load|, dimensionless
};

/// What beside a law's own parameters shapes friction and is a number: its name and bounds, and
/// where it is. Documented, read and written by this one table.
struct FrictionOption {
  ParameterInfo info;
  double FrictionDescription::*value;
};

/// level_per_temperature, viscous_per_energy, load_gain; 0 is the default and changes nothing.
std::span<const FrictionOption> FrictionOptions();

/// Gives the parameters that may be left out their defaults, where they are missing.
void FillDefaults(FrictionDescription& friction);

/// Checks names and bounds against the parameter tables, and that all parts make sense together:
///   static >= coulomb; what depends on E needs thermal; viscous_per_energy needs a law with a
///   slope, and a slope that falls as the joint warms; maps over motor_position lie on the circle.
/// Throws BadInput from `place`.
void CheckFriction(const FrictionDescription& friction, const Place& place);

/// The law's parameter values in the order of its table. The description must have been checked.
std::vector<double> LawValues(const FrictionDescription& friction);

/// {law, parameters{}, thermal{thermal_gain, thermal_time_constant, ambient, second{thermal_gain,
/// thermal_time_constant}}, gear, level_per_temperature, viscous_per_energy, load_gain, maps[]};
/// what is at its default is left out.
nlohmann::json FrictionToJson(const FrictionDescription& friction);

/// The inverse; checked. Unknown keys, missing parameters and wrong types throw BadInput.
FrictionDescription FrictionFromJson(const nlohmann::json& json, const Place& place);

/// Reads a friction file: an object with a `friction` member (as in estimate.json) or that member
/// by itself. Throws BadInput.
FrictionDescription ReadFrictionFile(const std::string& path);

}  // namespace warmjoint::inline models
