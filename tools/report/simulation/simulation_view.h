// What `simulate` made, as its pictures need it.
#pragma once

#include <filesystem>

#include "scenarios/scenario.h"
#include "sim/truth/truth.h"
#include "tools/report/figures/fit_view.h"

namespace warmjoint::report {

struct SimulationView {
  Scenario scenario;
  Recording recording;
  FitView fit;  // of the true friction to the recording
};

/// Takes the truth for an estimate that is right.
SimulationView MakeSimulationView(const Scenario& scenario, const Recording& recording);

/// Whether a directory holds what `simulate` writes.
bool IsSimulation(const std::filesystem::path& directory);

/// Reads scenario.yaml, recording.csv or recording.h5, and truth.json. Throws BadInput.
SimulationView ReadSimulationView(const std::filesystem::path& directory);

}  // namespace warmjoint::report
