// What identifiers of a run draw their starts from.
#pragma once

#include <cstdint>

#include "models/foundation/random_stream.h"

namespace warmjoint {

/// SHA-256 of the suite's seed and the realization: the same for every run of the suite, and no way
/// back to the random numbers of truth, motion and noise.
StartKey StartKeyOf(std::uint64_t seed, std::uint64_t realization);

}  // namespace warmjoint
