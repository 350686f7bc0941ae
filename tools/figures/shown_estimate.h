// What a reader is shown of an estimate: its numbers, and what it has to say.
#pragma once

#include <warmjoint/estimate.h>

#include <string>
#include <vector>

namespace warmjoint {

/// The rows of every table of parameters. Those of the law that only the prior of a map tells are left
/// out; "friction at 0.3 rad/s" at three speeds, which the data tell, stands behind the others in their
/// place.
std::vector<EstimatedParameter> ShownParameters(const Estimate& estimate);

/// All that an estimate says beside its status, a sentence each: its message, then its warnings.
std::vector<std::string> Remarks(const Estimate& estimate);

/// Three of them at most, those that count most: what was found, what would help where the answer failed,
/// and what must be known before numbers that pass are used, each warning by its first clause and its last.
std::vector<std::string> BriefRemarks(const Estimate& estimate);

}  // namespace warmjoint
