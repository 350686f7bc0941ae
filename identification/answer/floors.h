// Answers that are worthless or impossible, even where the tests for lack of fit find nothing.
#pragma once

#include <optional>

#include "identification/fit.h"
#include "identification/inference/cause.h"
#include "identification/inference/inference.h"

namespace warmjoint {

/// The row that refuses an answer; nothing where the answer is not refused. It is refused where
/// - it is fitted to fewer than 30 samples, or to less than 5 % of those at which the joint clearly moves;
/// - its friction is less than a few thousandths of the torque, so that the torque holds no friction;
/// - an inertia lies below 0 with its whole interval;
/// - one number, the mean of the torque, describes the torque better beyond chance, or, where the joint moves in both
/// directions, less than
///   20 % of the torque is explained (Fit);
/// - its residual exceeds half of the friction, in root mean square.
/// measurements: those that were fitted; inference: from the noise alone
std::optional<Cause> FloorCause(const Fit& fit, const LogSamples& measurements,
                                const Inference& inference);

/// The same by samples that a fit to others has not seen: it predicts them worse than their mean does. several_speeds: whether
/// the joint moves at several speeds there.
std::optional<Cause> FloorOfHeldOut(const Metrics& held_out, bool several_speeds, const Fit& fit);

}  // namespace warmjoint
