// What Eq. (22) leaves out: losses that follow the heat within a sampling interval.
#pragma once

#include <warmjoint/friction_model.h>
#include <warmjoint/prepared_log.h>

#include <Eigen/Core>

#include "identification/inference/inference.h"

namespace warmjoint {

/// Whether the step h of a log matters to its warming: (22) holds W over a step, in which E and
/// with it W changes, so that tau comes out too large by h |k v|/2 (to first order in h/tau); where
/// that is more than a quarter of the standard deviation of tau. velocity: [N], rad/s or m/s; step: h, s.
bool StepMatters(const Fit& fit, const Inference& inference, const Eigen::VectorXd& velocity,
                 double step);

/// The force of a friction whose losses follow its heat all the time, less its force by (22): 8/7
/// of what (22) with an eighth of each step makes of it. Constant speed over each step.
/// Returns [N] N.m or N.
Eigen::VectorXd ForceOfHeldLoss(const Friction& friction, const LogSamples& measurements,
                                const CourseStart& start = {});

}  // namespace warmjoint
