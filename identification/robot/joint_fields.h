// Fields about the fit of a joint of a robot: what its friction and its rigid torque may lack.
#pragma once

#include "identification/robot/robot_joint.h"

namespace warmjoint {

/// Adds fields to a joint's fit (FitWithFields), whose priors - of the description, the gain, a load - count as they are: the noise is that of the
/// fields. x and its covariance become those that are reported: level and slope of the friction between the 10 % and the 90 %
/// quantile of the speed. Nothing changes where no field is asked for.
void AddFields(const JointColumns& columns, const FieldSet& fields, JointFit& fit);

/// The torque along the log by the same structure fitted to some samples, from the given fit on: law, load, rigid torque, heat and maps, without what
/// drifts over this log alone. [N] N.m or N
Eigen::VectorXd PredictedBy(const JointFit& fit, const JointColumns& columns,
                            const ModelSamples& samples);

/// The friction of a fit's maps along the log. [N] N.m or N
Eigen::VectorXd FrictionOfMaps(const Friction& friction, const LogSamples& m);

}  // namespace warmjoint
