#include "models/friction/friction_description.h"

#include <array>

#include "models/friction/law.h"

namespace warmjoint::inline models {
namespace {

/// A level beyond so many times the load is a number that slipped.
constexpr double kLargestLoadGain = 100;

}  // namespace

std::span<const FrictionOption> FrictionOptions() {
  // each option with its name, symbol, unit, bounds and default
  static const std::array options{
      FrictionOption{{"level_per_temperature", "kT", kLevelPerTemperatureUnit, -kInfinity,
                      kInfinity, 0, "change of the level for each K of the ambient, once settled"},
                     &FrictionDescription::level_per_temperature},
      FrictionOption{{"viscous_per_energy", "b", kTimePerPositionUnit, -kInfinity, kInfinity, 0,
                      "(27) change of viscous for each unit of the energy state"},
                     &FrictionDescription::viscous_per_energy},
      FrictionOption{{"load_gain",
                      "c",
                      {"1", "1"},
                      0,
                      kLargestLoadGain,
                      0,
                      "growth of the level for each unit of the load's size"},
                     &FrictionDescription::load_gain},
  };
  return options;
}

void FillDefaults(FrictionDescription& friction) {
  const Law* law = FindLaw(friction.law);
  if (!law) return;
  for (const ParameterInfo& info : law->parameters) {
    // a number that must always be given has no default
    if (info.given == Given::always) continue;
    friction.parameters.try_emplace(std::string(info.name), info.default_value);
  }
}

std::vector<double> LawValues(const FrictionDescription& friction) {
  std::vector<double> values;
  for (const ParameterInfo& info : FindLaw(friction.law)->parameters) {
    values.push_back(friction.parameters.at(std::string(info.name)));
  }
  return values;
}

}  // namespace warmjoint::inline models
