// What `simulate` made, as its pictures need it.
#pragma once

#include <warmjoint/simulation.h>

#include <filesystem>

#include "scenarios/scenario.h"
#include "tools/shown/fit_view.h"
#include "tools/shown/shown_data.h"

namespace warmjoint::shown {

struct SimulationView {
  Scenario scenario;
  Simulation recording;
  FitView fit;  // of the true friction to the recording
};

/// Takes the truth for an estimate that is right.
SimulationView MakeSimulationView(const Scenario& scenario, const Simulation& recording);

/// Whether a directory holds what `simulate` writes.
bool IsSimulation(const std::filesystem::path& directory);

/// Reads scenario.yaml, recording.csv or recording.h5, and truth.json. Throws BadInput.
SimulationView ReadSimulationView(const std::filesystem::path& directory);

/// {name, fit, guess}: the truth along its recording, and what the first guess makes of it.
Tree SimulationFacts(const SimulationView& view, ShownData& data);

}  // namespace warmjoint::shown
