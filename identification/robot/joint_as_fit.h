// The fit of a joint of a robot in the form that fields, judgements and reports read.
#pragma once

#include <warmjoint/prepared_log.h>

#include "identification/fit/fit.h"
#include "identification/robot/robot_joint.h"

namespace warmjoint {

/// The value of a row of the table, in the row's unit.
double ValueOf(const JointFit& fit, Eigen::Index row);

/// Half width of an interval that noise gives a combination of rows. weights: [P]
double HalfWidthOf(const JointFit& fit, const Eigen::VectorXd& weights);

/// Whether the log determines the gain. Where it does not, the value is that of the other joints, and the curvature of the fit
/// says little of how large its error may be.
bool KnowsGain(const JointFit& fit);

/// The samples of a joint with the load that the fit gives. [N]
LogSamples SamplesOf(const JointFit& fit, const JointColumns& columns);

/// The fit, whose Jacobian is the model's. fit: must outlive it; samples: that it was fitted to
Fit FitOf(const JointFit& fit, const JointColumns& columns, const ModelSamples& samples);

}  // namespace warmjoint
