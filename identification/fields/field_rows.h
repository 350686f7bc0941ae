// The rows of a fit as fields see them: fewer, and linear in the unknowns.
#pragma once

#include <warmjoint/prepared_log.h>

#include "identification/fields/field_block.h"
#include "identification/fit/fit.h"

namespace warmjoint {

/// Means over the kept samples of some 40 ms, or less where the log has few, that move in one direction without a gap. torque: J x + residual, so that the unknowns of the
/// fit are those of the table; flat: J of the estimated rows, and then other columns. m: the motion that the model follows; others: [N x o];
/// left_out: [N] of the torque, that the fit did not see, N.m or N
FieldRows MakeFieldRows(const Fit& fit, const LogSamples& m, const Eigen::MatrixXd& others,
                        const Eigen::VectorXd& left_out);

/// The unknowns x of the table's estimated rows, in their coordinates. [p]
Eigen::VectorXd UnknownsOf(const Fit& fit);

}  // namespace warmjoint
