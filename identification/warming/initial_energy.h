// The heat with which a recording begins: what is known of it before a fit, and its estimate.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/friction_model.h>
#include <warmjoint/prepared_log.h>

#include <array>
#include <span>
#include <string>

#include "identification/fit/identifier.h"
#include "identification/options.h"
#include "identification/warming/thermal_fit.h"

namespace warmjoint {

/// E(0), as options have it.
enum class StartOfHeat { zero, estimated, expected };
inline std::span<const Word<StartOfHeat>> WordsOf(StartOfHeat) {
  static constexpr std::array words{Word{"zero", StartOfHeat::zero},
                                    Word{"estimated", StartOfHeat::estimated},
                                    Word{"expected", StartOfHeat::expected}};
  return words;
}

/// Options that say what is known of E(0).
struct InitialEnergyOptions {
  StartOfHeat initial_energy = StartOfHeat::zero;
  double expected_energy = 0;      // N.m or N
  double expected_energy_std = 0;  // N.m or N

  template <class A>
  void Serialize(A* a) {
    a->Field("initial_energy", &initial_energy,
             {.meaning = "E(0): 0 for a cold joint; estimated at a cost of accuracy; or expected "
                         "at about a value, as --follows has it"});
    a->Field("expected_energy", &expected_energy,
             {.meaning = "N.m or N; E(0) where it is expected"});
    a->Field("expected_energy_std", &expected_energy_std,
             {.bounds = {.at_least = 0},
              .meaning = "N.m or N; standard deviation of that; 0: known exactly"});
  }
};

/// Whether options have these, and take the joint for cold as the log begins.
bool TakesColdStart(const Options& options);

/// E(0) by these options; 0, a cold joint, where the options have none of them.
InitialEnergy InitialEnergyOf(const Options& options);

/// The sentence that the log itself contradicts what was expected, by more than four deviations of both;
/// empty where it does not. found: E(0) in a fit without the expectation; deviation: of `found`, N.m or N.
std::string ContradictsExpected(const InitialEnergy& expected, double found, double deviation);

/// E(0) of each recording and the jumps of E at gaps (gaps.h), as far as the estimate has them. What is
/// not estimated is 0.
/// measurements: those that the estimate was fitted to.
ThermalStart StartOf(const Estimate& estimate, const LogSamples& measurements);

}  // namespace warmjoint
