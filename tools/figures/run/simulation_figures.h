// What `simulate` made, as its pictures need it, and the family of these with its one list.
#pragma once

#include <warmjoint/simulation.h>

#include <filesystem>
#include <vector>

#include "scenarios/scenario.h"
#include "tools/figures/figure.h"
#include "tools/figures/fit_view.h"

namespace warmjoint::figures {

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

using SimulationFigure = NamedFigure<SimulationView>;

/// All that need no rendering: a new one is its own file and one line in simulation_figures.cc.
const std::vector<SimulationFigure>& SimulationFigures();

}  // namespace warmjoint::figures
