// Truth as JSON: the truth.json beside a simulated recording.
#pragma once

#include <warmjoint/simulation.h>

#include <string>

#include "models/foundation/node.h"

namespace warmjoint::inline sim {

/// {friction{}, initial_energy, torque_noise, plant, velocity[N], force[N], loss[N], energy[N]},
/// SI; where the noise is coloured also coloured_noise and correlation_time. Numbers read back bit
/// for bit.
Tree TruthToTree(const Truth& truth);

/// The inverse. Missing or unknown keys, arrays of unlike lengths and wrong types throw BadInput
/// with their place.
Truth TruthFrom(const Node& node);

}  // namespace warmjoint::inline sim
