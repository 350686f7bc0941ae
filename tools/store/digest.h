// Digests, by which results are known to be those that were stored.
#pragma once

#include <span>
#include <string>

#include "tools/store/result.h"
#include "tools/store/run_description.h"

namespace warmjoint::inline tools {

/// Digest of all that makes a run what it is: suite, versions, identifiers, variants.
std::string DigestOfPlan(const RunDescription& description);

/// Digest of one unit's results in the order of identifiers, without traces and wall times. plan:
/// DigestOfPlan. It tells accidents and edits; who recomputes it can forge it.
std::string DigestOfResults(const std::string& plan, Unit unit, std::span<const Result> results);

/// Digest of the trace of one result.
std::string DigestOfTrace(const std::string& plan, Unit unit, int identifier,
                          const TraceTable& trace);

}  // namespace warmjoint::inline tools
