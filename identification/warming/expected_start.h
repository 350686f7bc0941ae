// A start of which something is known: what a recording before left of the heat.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>

#include "identification/identifier.h"
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

/// What they say.
InitialEnergy InitialEnergyOf(const Options& options);

/// The sentence that the log itself contradicts what was expected, by more than four deviations of both;
/// empty where it does not. found: E(0) in a fit that knows nothing of it, deviation: of that, N.m or N.
std::string UnlikeBefore(const InitialEnergy& expected, double found, double deviation);

/// Fits once more where E(0) was expected, by the noise that the fit leaves: the fit before it knew no
/// noise to weigh the expectation by. Where the log contradicts what was expected (UnlikeBefore), E(0) is estimated from the log alone. loop, level, offsets, kept: as of
/// FitThermalFriction; fit: takes the place of the one given. deviation: of E(0) in a fit that knows
/// nothing of it, N.m or N. Returns the clause that tells of a contradiction, else an empty text.
std::string WeighStart(const ClosedLoop& loop, const Eigen::VectorXd& level,
                       const Eigen::MatrixXd& offsets, const Eigen::VectorXd& kept,
                       const std::function<double(const ThermalFit&)>& deviation, ThermalFit& fit);

}  // namespace warmjoint
