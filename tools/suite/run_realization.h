// One realization from plant to scores.
#pragma once

#include <warmjoint/simulation.h>

#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "scenarios/suite.h"
#include "sim/plant/plant.h"
#include "tools/store/result.h"
#include "tools/suite/prepared_identifier.h"

namespace warmjoint {

/// A scenario with its plant, for one thread.
struct Bench {
  Scenario scenario;
  std::unique_ptr<Plant> plant;
};

/// Throws BadInput where the plant cannot do the scenario.
Bench MakeBench(const Scenario& scenario);

/// Keeps recordings in a folder, or nowhere.
class RecordingKeeper {
 public:
  /// folder: made when it is needed; empty: nothing is kept.
  explicit RecordingKeeper(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Writes variant-V/realization-R.h5 and beside it realization-R.truth.json.
  void Keep(const Simulation& recording, RunUnit unit) const;

 private:
  std::filesystem::path folder_;
};

/// A unit that was simulated and identified.
struct RealizationResult {
  Realization realization;
  Following following;  // of the simulated joint
};

/// Simulates a unit on its variant's bench, keeps the recording where wanted, and scores every
/// identifier on it. Never throws for what happens in a plant or an identifier: it becomes the
/// status and message of the results concerned.
RealizationResult RunRealization(const Bench& bench,
                                 const std::vector<PreparedIdentifier>& identifiers, RunUnit unit,
                                 const RecordingKeeper& keeper);

}  // namespace warmjoint
