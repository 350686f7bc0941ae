// What columns in other units than a log is read in would do to the parameters.
#pragma once

#include "identification/lack_of_fit/examine.h"

namespace warmjoint {

/// Adds the rows degrees and clock: no residual shows either, where all columns of way or of time share the slip.
/// A parameter of dimension torque way^a time^b is f = w^a t^b times as large once way and time are w and t
/// times as large; each end of its interval moves by (f - 1) of itself, and the farther move counts.
/// degrees: w = pi/180; clock: t = 1.01.
void AddOtherUnits(const Fit& fit, const Inference& inference, JointKind joint,
                   Examination& examination);

}  // namespace warmjoint
