// What an estimate file leaves out of its fit, from the recording that it names.
#pragma once

#include <optional>

#include "identification/estimate.h"
#include "identification/preparation/prepared_log.h"

namespace warmjoint::inline tools {

/// An estimate without a friction, as a refused one, with the numbers and the friction of its fit, by the
/// identifier and the options that it names: to be looked at, not to be used. As it was where it has a
/// friction, or its identifier is none of ours.
Estimate WithFitAgain(Estimate estimate, const PreparedLog& log);

/// A fit to the samples before `split` (s), with the verdict on the whole.
struct HeldOutFit {
  double split = 0;
  Estimate estimate;
};

/// The fit behind the figures on held-out samples, the last `fraction` of the recording (hold_out.h).
/// Nothing where the identifier is none of ours or gives no friction there.
std::optional<HeldOutFit> FitFirstPartAgain(const Estimate& estimate, const PreparedLog& log,
                                            double fraction);

}  // namespace warmjoint::inline tools
