// One realization from plant to scores.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/prepared_log.h>
#include <warmjoint/score.h>
#include <warmjoint/simulation.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "models/foundation/random_stream.h"
#include "scenarios/suite.h"
#include "sim/plant/plant.h"
#include "tools/store/run_store.h"
#include "tools/suite/prepare_identifiers.h"

namespace warmjoint {

/// A scenario with its plant, for one thread.
struct Bench {
  Scenario scenario;
  std::unique_ptr<Plant> plant;
};

/// Throws BadInput where the plant cannot do the scenario.
Bench MakeBench(const Scenario& scenario);

/// A unit that was simulated and identified.
struct RealizationResult {
  Realization realization;
  Following following;  // of the simulated joint
};

/// Simulates a unit on its variant's bench, and scores everybody on it; compensators know the log of a day before, too. Never throws for what
/// happens in a plant or an identifier: it becomes the status and message of the results concerned.
/// recordings: a folder, made when it is needed, that gets variant-V/realization-R.h5 and beside it
/// realization-R.truth.json; empty: nothing is kept.
RealizationResult RunRealization(const Bench& bench, const Contestants& contestants, RunUnit unit,
                                 const std::filesystem::path& recordings);

/// Each iteration's fit, its NPE in both parametrisations, Eq. (26), and its parameters. Where a
/// trace has one thermal pair alone, the other follows by Eq. (22). `score` holds the truth.
/// step: sampling interval, s.
TraceTable MakeTraceTable(const std::vector<TraceEntry>& trace, const Score& score, double step);

/// SHA-256 of the suite's seed and the realization: the same for every run of the suite, and no way
/// back to the random numbers of truth, motion and noise.
StartKey StartKeyOf(std::uint64_t seed, std::uint64_t realization);

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
