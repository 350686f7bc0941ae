#include "identification/sentences/fit.h"

#include <fmt/format.h>

namespace warmjoint {

std::string ExplainStopped(std::size_t iterations, double rate, double remaining,
                           double tolerance) {
  return fmt::format(
      "stopped after {} iterations while the parameters still move: at the observed rate of {:.4f} "
      "an iteration they end up to {:.2g} % from here (tolerance {:.2g} %); give more iterations, "
      "or try --identifier energy-ml",
      iterations, rate, 100 * remaining, 100 * tolerance);
}

std::string ExplainStructure(std::string_view name, double deviations, Action action) {
  const bool drops = action == Action::drop_intervals;
  return fmt::format(
      "{}: treating its slow part as noise would change {} by {:.2g} standard errors{}",
      drops ? "no intervals are given, since the residual holds structure and not only noise"
            : "the residual is not only noise",
      name, deviations, drops ? "" : "; intervals were widened to cover this");
}

}  // namespace warmjoint
