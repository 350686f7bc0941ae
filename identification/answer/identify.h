// From a prepared log to an answer: fit, infer, find causes, apply, report.
#pragma once

#include <warmjoint/estimate.h>

#include <memory>

#include "identification/fit/identifier.h"
#include "identification/inference/inference.h"
#include "identification/lack_of_fit/find_lack_of_fit.h"
#include "identification/report/report_fit.h"

namespace warmjoint {

struct HeldOut;

/// A fit, and what is known of it.
struct Answer {
  Fit fit;
  Inference by_noise;  // with its friction at speeds
  Inference inferred;  // with the fit's own causes applied
  Inference judged;    // with all causes applied
  /// The time that the fit leaves out at the ends of its segments, where the torque had not settled, and the samples that were fitted.
  Settling settling{};
  std::shared_ptr<const Selection> settled{};  // null: all; the fit reads it, too
};

/// The input of an answer's fit: the samples that the identifier selects of `given`, at which the torque has settled. answer:
/// must outlive it.
IdentifierInput InputOf(const Answer& answer, const Identifier& identifier,
                        const IdentifierInput& given);

/// Fits and judges: what `identify` and `run` report. A log with faults (preparation/log_faults.h)
/// is bad_data, and the message names them; else the residual is examined for
/// structure (lack_of_fit/find_lack_of_fit.h). Effects of the log's preparation on the numbers are causes, too, and so are
/// floors (floors.h) below which no answer is ok.
/// Where the residual shows that the torque takes time to settle after a change of speed (settling.h), the fit is made again
/// without these samples.
Answer FitAndCheck(const Identifier& identifier, const IdentifierInput& input,
                   const LackOfFitSettings& judging = {});

/// Refuses an answer that figures on samples which a fit to others has not seen contradict (FloorOfHeldOut).
void JudgeHeldOut(const HeldOut& held_out, Answer& answer);

/// The judged answer as an estimate: FitAndCheck, ReportFit.
Estimate IdentifyAndCheck(const Identifier& identifier, const IdentifierInput& input,
                          const LackOfFitSettings& judging = {});

/// The same for an answer that was computed already.
Estimate ReportAnswer(const Identifier& identifier, const IdentifierInput& input,
                      const Answer& answer, RefusedNumbers numbers = RefusedNumbers::hide);

/// Without a verdict: the estimate that the fit gives by itself.
Estimate IdentifyUnchecked(const Identifier& identifier, const IdentifierInput& input);

}  // namespace warmjoint
