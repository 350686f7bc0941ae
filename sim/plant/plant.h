// What turns a scenario into a recording.
#pragma once

#include <warmjoint/simulation.h>

#include <cstdint>
#include <functional>
#include <memory>

#include "scenarios/scenario.h"

namespace warmjoint::inline sim {

/// Is told now and then which share of a run is done, 0 to 1.
using RunWatch = std::function<void(double share)>;

/// A plant carries out scenarios. One object may be used by one thread at a time; make one for
/// each.
class Plant {
 public:
  virtual ~Plant() = default;
  /// One realization: all its random numbers come from (scenario.seed, realization).
  /// Throws BadInput where the scenario asks what the plant cannot do. watch: of runs that take their time.
  Simulation Run(std::uint64_t realization, const RunWatch& watch = {}) {
    return CarryOut(realization, watch);
  }

 private:
  virtual Simulation CarryOut(std::uint64_t realization, const RunWatch& watch) = 0;
};

/// The plant that the scenario names, with its model loaded and checked. Throws BadInput.
std::unique_ptr<Plant> MakePlant(const Scenario& scenario);

}  // namespace warmjoint::inline sim
