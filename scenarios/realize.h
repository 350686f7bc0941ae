// One realization of a scenario whose truth is drawn.
#pragma once

#include <cstdint>

#include "scenarios/scenario.h"

namespace warmjoint {

/// The scenario with every drawn truth replaced by this realization's number, from
/// (scenario.seed, realization, Stream::truth). A scenario without draws comes back as it is.
Scenario Realize(const Scenario& scenario, std::uint64_t realization);

}  // namespace warmjoint
