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

/// The same identifier on the first part of the recording, with the verdict on the whole. Nothing where it is none of ours or gives no
/// friction there.
std::optional<Estimate> FitOnFirst(const Estimate& estimate, const PreparedLog& log, double share);

}  // namespace warmjoint::inline tools
