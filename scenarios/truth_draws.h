// What is drawn of a truth.
#pragma once

#include <warmjoint/friction.h>

#include <map>
#include <optional>
#include <string>

#include "models/foundation/node.h"
#include "models/foundation/random_stream.h"
#include "scenarios/distribution.h"
#include "scenarios/posterior.h"

namespace warmjoint {

/// Truth that is drawn anew for each realization.
struct TruthDraws {
  /// Dotted key within the scenario, for example friction.parameters.viscous or initial_energy, and its
  /// distribution.
  std::map<std::string, Distribution> numbers;
  std::optional<Posterior> posterior;  // of the friction's parameters

  bool empty() const { return numbers.empty() && !posterior; }
  bool operator==(const TruthDraws&) const = default;
};

/// A friction, its numbers that are drawn at their middles, as the key `friction` has it: as in a friction file, where any
/// number may be a distribution; the path of one; {estimate: FILE}, and with `draw: posterior` what the estimate leaves open.
struct DrawnFriction {
  Friction friction;
  TruthDraws draws;
};
void ReadValue(const Node& node, DrawnFriction* value, const FieldInfo& info);
Tree WriteValue(const DrawnFriction& value);

/// The truth of a scenario, at the middles of what is drawn.
struct DrawnTruth {
  Friction friction;
  double initial_energy = 0;
  TruthDraws draws;

  template <class A>
  void Serialize(A* a) {
    constexpr const char* energy_key = "initial_energy";
    const auto drawn = draws.numbers.find(energy_key);
    Distribution energy =
        drawn == draws.numbers.end() ? Distribution{.a = initial_energy} : drawn->second;
    draws.numbers.erase(energy_key);
    DrawnFriction whole{friction, draws};
    a->Field("friction", &whole,
             {.meaning = "the true friction as in a friction file, any number a distribution; a "
                         "friction file's path; or {estimate: FILE}",
              .needed = "give the true law and its parameters"});
    a->Field(energy_key, &energy, {.unit = "N.m", .meaning = "E(0), the heat at the start"});
    friction = whole.friction;
    draws = whole.draws;
    initial_energy = energy.a;
    if (energy.kind != Distribution::Kind::fixed) draws.numbers[energy_key] = energy;
  }
};

/// A friction of its draws. Throws BadInput from `place` where the posterior gives none within physical bounds.
Friction DrawFriction(const Friction& friction, const TruthDraws& draws, RandomStream& random,
                      const Place& place);

}  // namespace warmjoint
