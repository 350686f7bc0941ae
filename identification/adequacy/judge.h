// Whether a model is adequate: what the residual of its fit still shows.
#pragma once

#include "identification/identifier.h"
#include "identification/inference/inference.h"

namespace warmjoint::inline identification {

/// Judges a fit by what its residual shows.
/// Structure in the residual (smooth_structure.h, angle_structure.h) that is certain is large where
/// it amounts to a twentieth of the friction, rms over the kept samples, or to a fiftieth and a
/// fifth of the residual's variance, or where a parameter moves beyond its interval, by a twentieth
/// of the friction, once the structure joins the fit. Then the
/// estimate is void, inadequate_model, and the message names what the residual depends on and what
/// to try. Of smaller structure the estimate warns, and intervals reach as far as it moves them;
/// none is given of warming beside structure in time or energy, since nobody can tell how much of
/// that the warming took up. Where a start that is taken to be cold matters, the message says how
/// much.
/// Noise that is coloured is no structure: the intervals account for it.
/// Changes nothing of an inference that is not ok. input: what the identifier saw.
void JudgeAdequacy(const Identifier& identifier, const IdentifierInput& input, const Fit& fit,
                   Inference& inference);

}  // namespace warmjoint::inline identification
