// What is drawn of a truth.
#pragma once

#include <warmjoint/friction.h>

#include <map>
#include <optional>
#include <string>

#include "models/foundation/node.h"
#include "scenarios/distribution.h"
#include "scenarios/posterior.h"

namespace warmjoint {

/// The key of E(0), among those of what is drawn too.
inline constexpr const char* kInitialEnergy = "initial_energy";

/// Truth that is drawn anew for each realization.
struct TruthDraws {
  /// Dotted key within the scenario, for example friction.parameters.viscous or initial_energy, and its
  /// distribution.
  std::map<std::string, Distribution> numbers;
  std::optional<Posterior> posterior;  // of the friction's parameters

  bool empty() const { return numbers.empty() && !posterior; }
};

/// A friction, its numbers that are drawn at their middles, as the key `friction` has it: as in a friction file, where any
/// number may be a distribution; the path of one; {estimate: FILE}, and with `draw: posterior` what the estimate leaves open.
struct DrawnFriction {
  Friction friction;
  TruthDraws draws;
};
void ReadValue(const Node& node, DrawnFriction* value, const FieldInfo& info);
Tree WriteValue(const DrawnFriction& value);

}  // namespace warmjoint
