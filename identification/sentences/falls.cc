#include "identification/sentences/falls.h"

#include <fmt/format.h>

namespace warmjoint {

std::string ExplainTurns(double at_turns, double at_constant_speeds, const std::string& unit) {
  return fmt::format(
      "around reversals the residual is {:.3g} {} rms, at constant speeds {:.3g}: the law misses "
      "what happens there; accelerate more slowly, log faster, or try --identifier stribeck",
      at_turns, unit, at_constant_speeds);
}

}  // namespace warmjoint
