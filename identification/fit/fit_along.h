// A fit along the motion of a log.
#pragma once

#include <Eigen/Core>

#include "identification/fit/fit.h"
#include "identification/forward/log_trajectory.h"

namespace warmjoint {

/// The parts of a fit. Its friction grows with the load where the table has a row for that, whatever the value: derivatives by
/// that row need the load of a gain of 0, too.
FollowedBy PartsOf(const Fit& fit);

/// The friction of a fit along a motion that its torque follows, with the deflection of a bristle at each start as the fit
/// gives it, else as the torque gives it.
Prediction FrictionAlong(const Fit& fit, const LogSamples& followed);

/// F + G + M a of a model: G and M a, where the log has an acceleration, added to its friction F. friction: [N] N.m or N
Eigen::VectorXd WithRigid(const TorqueModel& model, const LogSamples& followed,
                          Eigen::VectorXd friction);

/// The same of a fit. [N] N.m or N
Eigen::VectorXd TorqueAlong(const Fit& fit, const LogSamples& followed);

}  // namespace warmjoint
