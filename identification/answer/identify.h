// From a prepared log to an answer: fit, infer, find causes, apply, report.
#pragma once

#include <warmjoint/estimate.h>

#include <memory>

#include "identification/identifier.h"
#include "identification/inference/inference.h"
#include "identification/lack_of_fit/find_lack_of_fit.h"
#include "identification/report/report_fit.h"

namespace warmjoint {

/// A fit, and what is known of it.
struct Answer {
  Fit fit;
  Inference by_noise;  // with its friction at speeds
  Inference inferred;  // what the fit's own causes leave of that
  Inference judged;    // and all causes
  /// What the fit leaves out at the ends of its segments, where the torque had not settled, and the samples that it rests on.
  Settling settling{};
  std::shared_ptr<const Selection> settled{};  // null: all; the fit reads it, too
};

/// The input that an answer rests on: what the identifier selects of `given`, once it has settled. answer: must outlive it.
IdentifierInput InputOf(const Answer& answer, const Identifier& identifier,
                        const IdentifierInput& given);

/// Fits and judges: what `identify` and `run` report. A log with faults (preparation/log_faults.h)
/// is bad_data, and the message names them; else the residual is examined for
/// structure (lack_of_fit/find_lack_of_fit.h). What the preparation of the log means for the numbers is a cause, too, and so are floors
/// (floors.h) below which no answer is ok.
/// Where the residual shows that the torque takes its time to settle after a change of speed (settling.h), the fit is made again
/// without these samples.
Answer FitAndCheck(const Identifier& identifier, const IdentifierInput& input,
                   const LackOfFitSettings& judging = {});

/// Refuses an answer that figures on samples which a fit to others has not seen contradict (FloorOfHeldOut).
void JudgeHeldOut(const Metrics& held_out, bool several_speeds, Answer& answer);

/// The judged answer as an estimate: FitAndCheck, ReportFit.
Estimate IdentifyAndCheck(const Identifier& identifier, const IdentifierInput& input,
                          const LackOfFitSettings& judging = {});

/// The same of an answer that is there already.
Estimate ReportAnswer(const Identifier& identifier, const IdentifierInput& input,
                      const Answer& answer, RefusedNumbers numbers = RefusedNumbers::hide);

/// Without a verdict: what the fit tells by itself.
Estimate IdentifyUnchecked(const Identifier& identifier, const IdentifierInput& input);

}  // namespace warmjoint
