#include "identification/warming/expected_start.h"

#include <cmath>

#include "identification/explain.h"

namespace warmjoint {
namespace {

constexpr double kBeyondDoubt = 4;  // deviations

}  // namespace

bool TakesColdStart(const Options& options) {
  const auto* start = options.Find<InitialEnergyOptions>();
  return start && start->initial_energy == StartOfHeat::zero;
}

InitialEnergy InitialEnergyOf(const Options& options) {
  const auto start = options.OrDefault<InitialEnergyOptions>();
  if (start.initial_energy == StartOfHeat::zero) return InitialEnergy::zero;
  if (start.initial_energy == StartOfHeat::estimated) return InitialEnergy::estimated;
  return {start.expected_energy, std::max(start.expected_energy_std, InitialEnergy::kExact)};
}

std::string ContradictsExpected(const InitialEnergy& expected, double found, double deviation) {
  const double off = found - expected.mean;
  if (std::abs(off) <= kBeyondDoubt * std::hypot(deviation, expected.spread)) return "";
  return ExplainUnexpectedStart(found, expected.mean, expected.spread);
}

}  // namespace warmjoint
