#include "identification/warming/initial_energy.h"

#include <cmath>

#include "identification/fit/fit_parameters.h"
#include "identification/sentences/heat.h"
#include "identification/warming/gaps.h"

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

ThermalStart StartOf(const Estimate& estimate, const LogSamples& measurements) {
  ThermalStart start;
  start.energy = ValueOf(Role::start, estimate).value_or(0);
  // each gap and each further recording has its own, 0 where none was estimated
  const std::vector<LogGap> gaps = Merged(FindGaps(measurements), FurtherStarts(measurements));
  const std::vector<std::string> names = JumpNames(gaps, measurements);
  for (size_t i = 0; i < gaps.size(); ++i) {
    const EstimatedParameter* found = estimate.Find(names[i]);
    if (found) start.jumps.push_back({gaps[i].behind, found->value});
  }
  return start;
}

}  // namespace warmjoint
