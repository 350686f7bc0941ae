// The family of pictures that a simulated recording gives, and its one list.
#pragma once

#include <vector>

#include "tools/report/draw/named_figure.h"
#include "tools/report/simulation/simulation_view.h"

namespace warmjoint::report {

using SimulationFigure = NamedFigure<SimulationView>;

/// All that need no rendering: a new one is its own file and one line in simulation_figures.cc.
const std::vector<SimulationFigure>& SimulationFigures();

}  // namespace warmjoint::report
