// The way from a prepared log to an answer: fit, infer, judge, report.
#pragma once

#include <warmjoint/estimate.h>

#include "identification/identifier.h"
#include "identification/inference/inference.h"
#include "identification/lack_of_fit/judging.h"

namespace warmjoint {

/// A fit, what it tells by itself, and what the verdict leaves of that.
struct Answer {
  Fit fit;
  Inference inferred;
  Inference judged;
};

/// Fits and judges: what `identify` and `run` report. A log with faults (preparation/log_faults.h)
/// makes the inference void, bad_data, and its message names them; else the residual is examined for
/// structure (lack_of_fit/judge.h), and what the preparation of the log means for the numbers is told. No answer is ok that
/// rests on fewer than 30 samples or a twentieth of those that move, or that the mean of the torque beats beyond chance.
Answer FitAndJudge(const Identifier& identifier, const IdentifierInput& input,
                   const Judging& judging = {});

/// The judged answer as an estimate: FitAndJudge, ReportFit, TellPreparation.
Estimate IdentifyAndJudge(const Identifier& identifier, const IdentifierInput& input,
                          const Judging& judging = {});

/// The same of an answer that is there already.
Estimate ReportAnswer(const Identifier& identifier, const IdentifierInput& input,
                      const Answer& answer);

/// Without a verdict: what the fit tells by itself.
Estimate IdentifyUnjudged(const Identifier& identifier, const IdentifierInput& input);

/// What --force shows of a judged answer: its status and its figures with the numbers of the answer
/// before the verdict, and a message that calls them void. An answer that was not voided by the
/// verdict stays as it is.
Estimate WithVoidNumbers(const Identifier& identifier, const IdentifierInput& input,
                         const Answer& answer);

}  // namespace warmjoint
