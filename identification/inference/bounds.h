// Whether the values of a fit make a friction: physical bounds.
#pragma once

#include "identification/inference/inference.h"

namespace warmjoint::inline identification {

/// Voids an inference some law parameter of which lies outside of its bound with the whole of its
/// interval, or whose static level is below its Coulomb level. Where only the value lies outside, no
/// friction is given and a warning says so; else the friction may be used.
void JudgeBounds(const Fit& fit, Inference& inference);

/// Whether the fit's friction may be used: nothing refuses it, its values lie inside of their physical
/// bounds, and its static level is not below its Coulomb level. That of Infer, without its covariance.
bool GivesFriction(const Fit& fit);

/// Whether the value of a law parameter lies outside of its bounds, by chance or not.
bool LeavesBounds(const std::vector<FitParameter>& parameters);

}  // namespace warmjoint::inline identification
