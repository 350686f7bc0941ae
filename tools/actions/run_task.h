// What `run` does before and after the realizations of a suite.
#pragma once

#include <vector>

#include "tools/actions/run_arguments.h"
#include "tools/actions/run_ending.h"
#include "tools/store/run_store.h"
#include "tools/suite/prepared_identifier.h"
#include "tools/suite/shard.h"

namespace warmjoint {

/// A run that was asked for and checked.
struct RunTask {
  Suite suite;
  std::vector<PreparedIdentifier> identifiers;
  Shard shard;
  int jobs = 1;  // threads
  RunDescription description;
};

/// Everything that can be refused is, before anything is written. Throws BadInput.
RunTask PrepareRun(const RunArguments& arguments);

/// Writes results.csv and summary.csv, and sums up.
RunEnding EndRun(RunStore& store);

}  // namespace warmjoint
