// One realization of a run, simulated and identified once more.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/prepared_log.h>

#include "scenarios/suite.h"
#include "tools/store/run_store.h"

namespace warmjoint {

/// A realization with what an identifier makes of it.
struct Replayed {
  PreparedLog log;
  Estimate estimate;
};

/// Simulates `unit` as the run did and identifies it with the same start. identifier: an entry of the suite
/// that is no command from outside. Throws BadInput where the plant or the identifier cannot be made here.
Replayed ReplayUnit(const Suite& suite, RunUnit unit, const SuiteIdentifier& identifier);

/// "realization 17", with its variant where the suite has any.
std::string NameOf(const Suite& suite, RunUnit unit);

/// The command that simulates it again. run: the directory, as a reader calls it.
std::string ReplayCommand(const Suite& suite, RunUnit unit, const std::string& run);

}  // namespace warmjoint
