// Whether a model is adequate: what the residual of its fit still shows.
#pragma once

#include "identification/identifier.h"
#include "identification/preparation/finer_input.h"

namespace warmjoint::inline identification {

/// Runs an identifier and judges its answer: what `identify` and `run` report.
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
/// A log with faults (preparation/log_faults.h) makes the estimate void, bad_data, and the message
/// names them.
Estimate IdentifyAndJudge(const Identifier& identifier, const IdentifierInput& given);

/// An answer before its verdict and after.
struct Judgement {
  Estimate before;
  Estimate judged;
};

/// The same, of an input that is prepared already.
Judgement IdentifyAndJudge(const Identifier& identifier, const FinerInput& finer);

/// The same for an answer that is there already.
void JudgeAdequacy(const Identifier& identifier, const IdentifierInput& input, Estimate& estimate);

/// What --force shows of a judged answer: its status and its figures with the numbers of the answer
/// before the verdict, and a message that calls them void. An answer that was not voided by the
/// verdict stays as it is.
Estimate WithVoidNumbers(const Estimate& judged, const Estimate& before);

}  // namespace warmjoint::inline identification
