// The plant of Sec. III: the paper's simulation, exactly, without an engine.
#pragma once

#include <memory>

#include "sim/plant/plant.h"

namespace warmjoint::inline sim {

/// Samples the planned velocity at h = 1 / sampling.rate, lets friction warm as AlongMotion does,
/// E2 from 0, and logs torque = F + white noise, with no inertia, controller or filter.
/// The position is the integral of the planned velocity. Velocity and position get their own noise.
/// Throws BadInput for a motion that travels between the limits of a robot: it has none. Its Run
/// throws BadInput where friction changes its sign and feeds itself (E below -Fn sign(v)).
std::unique_ptr<Plant> MakeIdealPlant(const Scenario& scenario);

}  // namespace warmjoint::inline sim
