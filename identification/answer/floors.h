// Answers that are worthless or impossible, whatever the tests for lack of fit let pass.
#pragma once

#include <optional>

#include "identification/fit.h"
#include "identification/inference/cause.h"
#include "identification/inference/inference.h"

namespace warmjoint {

/// The row that refuses such an answer; nothing where it stands. It is refused where
/// - it rests on fewer than 30 samples, or on less than 5 % of those that move clearly;
/// - its friction is a few thousandths of the torque: that holds none;
/// - an inertia lies below 0 with its whole interval;
/// - one number, the mean of the torque, follows this better beyond chance, or, where the joint moves in both directions, less than
///   20 % of the torque is explained (Fit);
/// - what it leaves exceeds half of the friction, in root mean square.
/// measurements: that were fitted; inference: what noise says
std::optional<Cause> FloorCause(const Fit& fit, const LogSamples& measurements,
                                const Inference& inference);

/// The same by samples that a fit to others has not seen: it predicts them worse than their mean does. several_speeds: whether
/// they move at several.
std::optional<Cause> FloorOfHeldOut(const Metrics& held_out, bool several_speeds, const Fit& fit);

}  // namespace warmjoint
