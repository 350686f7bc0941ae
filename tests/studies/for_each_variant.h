// What the studies of suites share: their command line, logs that a fit has not seen, and what counts as wrong.
#pragma once

#include <fmt/format.h>
#include <warmjoint/score.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>

#include "models/foundation/bad_input.h"
#include "models/foundation/parse_number.h"
#include "scenarios/suite.h"
#include "sim/plant/plant.h"

namespace warmjoint {

/// NAME SUITE.yaml [REALIZATIONS [VARIANT...]]: calls study(suite, variant, realizations) for each variant that is
/// asked for, all where none is. Returns the exit status.
inline int StudyVariants(const char* name, int count, char** arguments,
                         const std::function<void(const Suite&, int, int)>& study) {
  if (count < 2) {
    fmt::print(stderr, "{} SUITE.yaml [REALIZATIONS [VARIANT...]]\n", name);
    return 2;
  }
  try {
    const Suite suite = ReadSuite(arguments[1]);
    const std::optional<double> given = count > 2 ? ParseNumber(arguments[2]) : std::nullopt;
    const int realizations = given ? static_cast<int>(*given) : suite.realizations;
    for (int variant = 0; variant < suite.variants(); ++variant) {
      const bool wanted =
          count < 4 ||
          (suite.ladder && std::find(arguments + 3, arguments + count,
                                     suite.ladder->variants[static_cast<size_t>(variant)].name) !=
                               arguments + count);
      if (wanted) study(suite, variant, realizations);
    }
  } catch (const BadInput& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  return 0;
}

/// The joint of a recording, its speeds and noise drawn anew.
inline Simulation MovedAnew(Scenario scenario, const Truth& truth, int realization) {
  scenario.friction = truth.friction;
  scenario.initial_energy = truth.initial_energy;
  scenario.draws = {};
  return MakePlant(scenario)->Run(static_cast<std::uint64_t>(realization));
}

inline constexpr double kIntervalWidth = 3.92;  // deviations of a 95 % interval of known variance
inline constexpr double kFarDeviations = 3;     // beyond an end of it

/// Whether the truth lies more than three deviations (interval / 3.92) beyond an end of the interval.
inline bool IsFarOutside(const ParameterScore& one, const std::array<double, 2>& interval) {
  const double deviation = (interval[1] - interval[0]) / kIntervalWidth;
  return one.truth < interval[0] - kFarDeviations * deviation ||
         one.truth > interval[1] + kFarDeviations * deviation;
}

}  // namespace warmjoint
