// What became of the results of a run.
#pragma once

#include <warmjoint/suite.h>

#include <string>

#include "tools/store/run_store.h"

namespace warmjoint {

/// Sums up a store.
RunEnding EndingOf(const RunStore& store);

/// "200 results, 99 refused by their own verdict, 1 without an answer".
std::string CountsInWords(const RunEnding& ending);

}  // namespace warmjoint
