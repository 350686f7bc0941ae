// One joint's friction as plain data: what a friction file holds (friction_json.h), and what estimates,
// scenarios, the plugin and `attach` exchange.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "models/friction/friction_map.h"
#include "models/friction/law.h"
#include "models/friction/thermal.h"

namespace warmjoint::inline models {

/// The heat of a friction as files hold it.
struct Warming {
  Thermal first;
  double ambient = 0;             // degC
  std::optional<Thermal> second;  // stage

  template <class A>
  void Serialize(A* a) {
    first.Serialize(a);
    a->Field("ambient", &ambient,
             {.unit = "degC", .meaning = "temperature at which the law holds"});
    a->Field("second", &second, {.meaning = "a second stage of warming, fed by the same loss"});
  }
};

struct FrictionOption;

/// level_per_temperature, viscous_per_energy, load_gain; 0 is the default and changes nothing.
std::span<const FrictionOption> FrictionOptions();

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
  std::string torque_unit{};  // "A" of a friction in amperes, which MuJoCo cannot use; else empty

  template <class A>
  void Serialize(A* a);
};

/// What beside a law's own parameters shapes friction and is a number: its name and bounds, and
/// where it is. Documented, read and written by this one table.
struct FrictionOption {
  ParameterInfo info;
  double FrictionDescription::*value;
};

template <class A>
void FrictionDescription::Serialize(A* a) {
  a->Field("law", &law, {.meaning = "nominal law", .needed = "give one of its names as text"});
  a->Field("parameters", &parameters, {.meaning = "of the law, SI"});
  a->Field("gear", &gear, {.meaning = "motor turns for each joint turn"});
  // heat stands in one map
  std::optional<Warming> warming;
  if (thermal) warming = Warming{*thermal, ambient, second_thermal};
  a->Field("thermal", &warming);
  if (warming) {
    thermal = warming->first;
    ambient = warming->ambient;
    second_thermal = warming->second;
  }

  // what changes nothing is left out
  constexpr auto left_out = AtDefault::left_out;
  for (const FrictionOption& option : FrictionOptions()) {
    a->Field(
        option.info.name, &(this->*option.value),
        {.unit = option.info.unit.rotary, .meaning = option.info.meaning, .at_default = left_out});
  }
  a->Field("torque_unit", &torque_unit,
           {.meaning = "A, where torque is a current", .at_default = left_out});
  a->Check(torque_unit.empty() || torque_unit == "A", "torque_unit", "A, or absent");
  a->Field("maps", &maps, {.at_default = left_out});
}

/// Gives the parameters that may be left out their defaults, where they are missing.
void FillDefaults(FrictionDescription& friction);

/// The law's parameter values in the order of its table. The description must have been checked
/// (check_friction.h).
std::vector<double> LawValues(const FrictionDescription& friction);

}  // namespace warmjoint::inline models
