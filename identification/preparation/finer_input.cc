#include "identification/preparation/finer_input.h"

#include <fmt/format.h>

namespace warmjoint::inline identification {

void WarnOfUnseenReversals(double unseen, Estimate& estimate) {
  if (unseen < 0.005 || !estimate.Find("thermal_gain")) return;
  estimate.warnings.push_back(fmt::format(
      "reversals happen between two samples, so that a slow drive could have travelled {:.1f} % "
      "less than is charged: thermal_gain may be too small by as much; log faster to see them",
      100 * unseen));
}

}  // namespace warmjoint::inline identification
