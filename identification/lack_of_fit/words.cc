#include "identification/lack_of_fit/words.h"

#include <fmt/format.h>

#include <algorithm>

namespace warmjoint::inline identification {

std::string DescribeFinding(const Examination& examination, const Finding& finding,
                            const Measurements& measurements) {
  const double rms = examination.Rms(finding);
  const double share = std::min(finding.explained / examination.squares, 1.0);
  return fmt::format(
      "{}: {:.3g} {} rms, {:.2g} % of the friction, {:.0f} % of the residual's variance",
      finding.test->quantity(finding, measurements), rms, measurements.torque_unit,
      100 * rms / examination.friction, 100 * share);
}

}  // namespace warmjoint::inline identification
