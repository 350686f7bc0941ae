// Whether a model is adequate: what the residual of its fit still shows.
#pragma once

#include "identification/identifier.h"
#include "identification/inference/inference.h"
#include "identification/lack_of_fit/judging.h"

namespace warmjoint {

/// Judges a fit by the table of tests for lack of fit (table.h), made at one error level for the log
/// (error_level.h). What they find is relevant where one finding changes the friction of law and heat by
/// more than the share `judging.relevance` of its rms over the kept samples (Harm), or where all together
/// amount to a quarter of it. Then the inference is void, inadequate_model, and the message names what the
/// residual depends on and what to try. Of less the inference warns, and intervals reach as far as the
/// parameters would move were it part of the model; none is given of warming beside lack of fit over time or
/// energy, since nobody can tell
/// how much of that the warming took up. Where a start that is taken to be cold matters, a warning
/// says how much. Noise that is coloured is no lack of fit: the intervals account for it.
/// Fills diagnostics and assumptions; of an inference that is not ok, nothing else.
/// input: what the identifier saw.
void JudgeLackOfFit(const Identifier& identifier, const IdentifierInput& input, const Fit& fit,
                    const Judging& judging, Inference& inference);

}  // namespace warmjoint
