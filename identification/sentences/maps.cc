#include "identification/sentences/maps.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <warmjoint/friction.h>

namespace warmjoint {

std::string ExplainHeldBesideMaps(const FitParameter& parameter) {
  return fmt::format("noise puts {} beyond its bound {}, so it is set to that", parameter.name,
                     parameter.lower);
}

std::string ExplainImitated(const std::vector<std::string>& names) {
  return fmt::format(
      "the data cannot separate {} from the map; use total friction (at the speeds given, and "
      "bands), not {}",
      fmt::join(names, ", "), names.size() == 1 ? "this number" : "these numbers");
}

std::string ExplainDrivingFriction(const FrictionAtSpeed& at, const LogSamples& measurements,
                                   const Fit& fit) {
  return fmt::format(
      "the friction drives the joint: at {:.3g} {} it is {:.3g} {}; {} its sign reversed (--scale "
      "torque=-1)?",
      at.speed, kVelocityUnit.For(measurements.joint), at.value, measurements.torque_unit,
      fit.gravity ? "is" : "does the torque hold gravity (--gravity sincos), or is");
}

std::string ExplainHoles(const std::vector<std::string>& holes) {
  return fmt::format(
      "the map has no data at {}: it follows its neighbours there, and its bands are wide",
      fmt::join(holes, ", "));
}

std::string ExplainMotorRipple(bool forwards, const std::vector<std::pair<int, double>>& harmonics,
                               const std::string& unit) {
  std::string found;
  for (const auto& [multiple, amplitude] : harmonics) {
    found += fmt::format("{}{:.3g} {} at {} a turn", found.empty() ? "" : ", ", amplitude, unit,
                         multiple);
  }
  return fmt::format("motor ripple for v {} 0: {}", forwards ? ">" : "<",
                     found.empty() ? "none above the noise" : found);
}

std::string ExplainWarmingBesideMaps(int iterations) {
  return fmt::format("warming with them in {} iterations", iterations);
}

std::string ExplainMapsOverEnergy(int rounds) {
  return fmt::format(
      "the energy state is consistent with the losses of the fit after {} rounds; thermal_gain and "
      "thermal_time_constant have no interval, since maps over the energy absorb part of their "
      "effect",
      rounds);
}

}  // namespace warmjoint
