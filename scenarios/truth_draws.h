// What is drawn of a truth.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "scenarios/distribution.h"
#include "scenarios/posterior.h"

namespace warmjoint::inline scenarios {

/// Truth that is drawn anew for each realization.
struct TruthDraws {
  /// Dotted key within the scenario, for example friction.parameters.viscous or initial_energy, and its
  /// distribution.
  std::map<std::string, Distribution> numbers;
  std::optional<Posterior> posterior;  // of the friction's parameters

  bool empty() const { return numbers.empty() && !posterior; }
  bool operator==(const TruthDraws&) const = default;
};

}  // namespace warmjoint::inline scenarios
