#include "identification/lack_of_fit/words.h"

#include <fmt/format.h>

#include <algorithm>

namespace warmjoint {

std::string DescribeFinding(const Examination& examination, const Finding& finding,
                            const Measurements& measurements) {
  const double rms = examination.Rms(finding);
  const double share = 100 * std::min(finding.explained / examination.squares, 1.0);
  return fmt::format(
      "{}: {:.3g} {} rms, {:.2g} % of the friction, {:.{}f} % of the residual's variance",
      finding.test->quantity(finding, measurements), rms, measurements.torque_unit,
      100 * rms / examination.friction, share, share < 0.95 ? 1 : 0);
}

}  // namespace warmjoint
