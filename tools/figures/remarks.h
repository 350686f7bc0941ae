// What an estimate has to say, as sentences.
#pragma once

#include <warmjoint/estimate.h>

#include <string>
#include <vector>

namespace warmjoint {

/// All that an estimate says beside its status, a sentence each: its message, then its warnings.
std::vector<std::string> Remarks(const Estimate& estimate);

/// Three of them at most, those that count most: what was found, what would help where the answer failed,
/// and what must be known before numbers that pass are used, each warning by its first clause and its last.
std::vector<std::string> BriefRemarks(const Estimate& estimate);

}  // namespace warmjoint
