// What `run` does before and after the realizations of a suite.
#pragma once

#include <warmjoint/suite.h>

#include <filesystem>
#include <string>
#include <vector>

#include "scenarios/suite.h"
#include "tools/store/run_store.h"
#include "tools/suite/engine.h"
#include "tools/suite/prepare_identifiers.h"

namespace warmjoint {

/// Names of the project's suites, sorted: each is a file of scenarios/suites.
std::vector<std::string> SuiteNames();

/// The file of one of them.
std::filesystem::path SuiteFile(const std::string& name);

/// The file of a suite: the path itself where there is such a file, else that of the project's suite of
/// this name. Throws BadInput with the nearest name.
std::string FindSuite(const std::string& name_or_path);

/// The suite with what the command line changes. Throws BadInput for a command that the suite brings
/// along and nobody has agreed to.
Suite ResolveSuite(const RunArguments& arguments);

/// Sums up a store.
RunEnding EndingOf(const RunStore& store);

/// "200 results, 99 rejected by their own tests, 1 without an answer".
std::string CountsInWords(const RunEnding& ending);

/// A run that was asked for and checked.
struct RunTask {
  Suite suite;
  Contestants contestants;
  Shard shard;
  int jobs = 1;  // threads
  RunDescription description;
};

/// Everything that can be refused is, before anything is written. Throws BadInput.
RunTask PrepareRun(RunArguments arguments);

/// Writes results.csv and summary.csv, and sums up.
RunEnding EndRun(RunStore& store);

}  // namespace warmjoint
