// The tables of a run that people read.
#pragma once

#include <cstddef>

#include "tools/store/run_store.h"

namespace warmjoint::inline tools {

/// Writes RUN/results.csv, a row for each result (ExportResults), and RUN/summary.csv, the leaderboard: a
/// row for each identifier over all variants, and for each variant of a ladder. Wall times stay out of
/// both, so that equal results are equal bytes. Returns the number of results. Memory does not grow
/// with the run.
std::size_t WriteTables(const RunStore& store);

}  // namespace warmjoint::inline tools
