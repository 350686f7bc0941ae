// The acceleration of a drive, from those of its ramps that samples show.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "identification/preparation/speed_change.h"

namespace warmjoint {

/// Gives the changes of speed whose ramp no sample shows the acceleration of those that samples do
/// show, where that is one: a drive has one limit. A ramp that would reach past a sample would have
/// shown. time: [N] s; changes: those that were found, with duration 0 where no ramp shows
void ShareAcceleration(const Eigen::VectorXd& time,
                       std::vector<std::optional<SpeedChange>>& changes);

}  // namespace warmjoint
