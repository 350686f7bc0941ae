// A fit along the motion of a log.
#pragma once

#include <Eigen/Core>

#include "identification/fit/fit.h"
#include "identification/forward/log_trajectory.h"

namespace warmjoint {

/// The parts of a fit. Its friction grows with the load where the table has a row for that, whatever the value: derivatives by
/// that row need the load of a gain of 0, too.
FollowedBy PartsOf(const Fit& fit);

/// F + G + M a of a fit along a motion that its torque follows. [N] N.m or N
Eigen::VectorXd TorqueAlong(const Fit& fit, const LogSamples& followed);

}  // namespace warmjoint
