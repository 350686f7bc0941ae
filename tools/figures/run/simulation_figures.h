// The family of pictures that a simulated recording gives, and its one list.
#pragma once

#include <vector>

#include "tools/figures/figure.h"
#include "tools/figures/run/simulation_view.h"

namespace warmjoint::figures {

using SimulationFigure = NamedFigure<SimulationView>;

/// All that need no rendering: a new one is its own file and one line in simulation_figures.cc.
const std::vector<SimulationFigure>& SimulationFigures();

}  // namespace warmjoint::figures
