// Answers that are worthless or impossible, even where the tests for lack of fit find nothing.
#pragma once

#include <optional>

#include "identification/fit/cause.h"
#include "identification/fit/fit.h"
#include "identification/holdout/hold_out.h"
#include "identification/inference/inference.h"

namespace warmjoint {

/// The row that refuses an answer; nothing where the answer is not refused. It is refused where
/// - it is fitted to fewer than 30 samples, or to less than 5 % of those at which the joint clearly moves;
/// - its friction is less than a few thousandths of the torque, so that the torque holds no friction;
/// - an inertia was below 0 with its whole interval, and the friction without it differs by more than the share `relevance` of its
/// rms (WithoutNegativeInertia);
/// - one number, the mean of the torque, describes the torque better beyond chance, or, where the joint moves in both
/// directions, less than
///   20 % of the torque is explained (Fit);
/// - its residual is too large (LeavesTooMuch).
/// measurements: those that were fitted; by_noise: the inference from the noise alone, with its friction at speeds
std::optional<Cause> FloorCause(const Fit& fit, const LogSamples& measurements,
                                const Inference& by_noise, double relevance);

/// Whether a residual exceeds half of a friction that is the larger part of the torque. Where the other part is the larger one, a
/// residual may be small and exceed the friction: how well that is known is for its interval to say (UnknownFriction).
/// Each in root mean square: left of the torque, of the friction, of what else was fitted (gravity, inertia). N.m or N
bool LeavesTooMuch(double left, double friction, double others);

/// The same by samples that a fit to others has not seen: it predicts them worse than what is left without friction does. Only
/// where the joint moves there in both directions and at several speeds; else an offset of the torque, or one level, decides.
std::optional<Cause> FloorOfHeldOut(const HeldOut& held_out, const Fit& fit);

}  // namespace warmjoint
