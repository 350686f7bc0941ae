// Whether the intervals of a fit reach into the physical bounds of a friction.
#pragma once

#include "identification/inference/inference.h"

namespace warmjoint::inline identification {

/// Voids an inference some law parameter of which lies outside of its bound with the whole of its
/// interval, or whose static level is below its Coulomb level. Where only the value lies outside, no
/// friction is given and a warning says so; else the friction may be used.
void JudgeBounds(const Fit& fit, Inference& inference);

}  // namespace warmjoint::inline identification
