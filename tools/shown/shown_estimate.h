// What a reader is shown of an estimate: its numbers, and what it has to say.
#pragma once

#include <warmjoint/estimate.h>

#include <optional>
#include <string>
#include <vector>

namespace warmjoint {

/// The parameters, without those of the law of which only friction at speeds is known, without the discrete pair, which
/// repeats gain and time constant, and without a delay of less than two half widths of its interval.
std::vector<EstimatedParameter> OwnParameters(const Estimate& estimate);

/// The rows of every table of one estimate: friction at speeds first, "friction forwards at 0.3 rad/s", then its parameters.
std::vector<EstimatedParameter> ShownParameters(const Estimate& estimate);

/// "0 to 0.41" of a value that rests at an end of its interval, since a bound holds it: all that is known is how far it may reach. Nothing
/// of other values.
std::optional<std::string> RangeAtBound(const EstimatedParameter& one);

/// The assumptions, without that of the unit of angles where it was stated.
std::vector<Assumption> ShownAssumptions(const Estimate& estimate);

/// The clause as a sentence: a capital at its beginning, unless a name stands there, and a stop.
std::string AsSentence(std::string clause);

/// All that an estimate says beside its status, a sentence each: its message, then its warnings.
std::vector<std::string> Remarks(const Estimate& estimate);

/// Three of them at most, those that count most: what was found, what would help where the answer failed,
/// and what must be known before numbers that pass are used, each warning by its first clause and its last.
std::vector<std::string> BriefRemarks(const Estimate& estimate);

}  // namespace warmjoint
