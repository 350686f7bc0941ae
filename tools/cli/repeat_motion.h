// A recorded motion carried out again in simulation: `simulate --motion`.
#pragma once

#include <string>

#include "models/recording/measurements.h"
#include "scenarios/setting.h"

namespace warmjoint::inline tools {

/// The motion and the duration of a recording, as entries of a scenario. Throws BadInput where it
/// never moves at a constant speed.
Settings MotionSettings(const Measurements& log);

/// One line on how far the simulated torque is from the recorded one where the recording moves at a
/// constant speed. The simulation begins where the recording does; where its samples lie between
/// the recorded times, a line between them counts.
std::string CompareTorque(const Measurements& log, const Measurements& simulated);

}  // namespace warmjoint::inline tools
