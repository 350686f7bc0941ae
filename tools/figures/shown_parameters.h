// The numbers of an estimate that a reader is shown.
#pragma once

#include <warmjoint/estimate.h>

#include <vector>

namespace warmjoint {

/// The rows of every table of parameters. Those of the law that only the prior of a map tells are left
/// out; "friction at 0.3 rad/s" at three speeds, which the data tell, stands behind the others in their
/// place.
std::vector<EstimatedParameter> ShownParameters(const Estimate& estimate);

}  // namespace warmjoint
