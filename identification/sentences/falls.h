// Of laws whose friction falls with speed, Stribeck's and LuGre.
#pragma once

#include <string>

namespace warmjoint {

/// Of a law that misses what happens at turns. Residuals, rms in `unit`
std::string ExplainTurns(double at_turns, double at_constant_speeds, const std::string& unit);

}  // namespace warmjoint
