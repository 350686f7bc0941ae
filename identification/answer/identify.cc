#include "identification/answer/identify.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "identification/lack_of_fit/judge.h"
#include "identification/report/report_fit.h"
#include "identification/report/tell_preparation.h"
#include "identification/seen_samples.h"

namespace warmjoint::inline identification {

Answer FitAndJudge(const Identifier& identifier, const IdentifierInput& given,
                   const Judging& judging) {
  const IdentifierInput input = Seen(identifier, given);

  // fit, then infer
  Answer answer;
  answer.fit = identifier.fit(input);
  answer.inferred = Infer(answer.fit);

  // judge
  answer.judged = answer.inferred;
  const std::vector<std::string>& faults = input.log.faults();
  if (faults.empty()) {
    JudgeLackOfFit(identifier, input, answer.fit, judging, answer.judged);
  } else {
    answer.judged.Void(Status::bad_data, fmt::format("{}", fmt::join(faults, "; and ")));
  }
  return answer;
}

Estimate ReportAnswer(const Identifier& identifier, const IdentifierInput& given,
                      const Answer& answer) {
  const IdentifierInput input = Seen(identifier, given);
  Estimate estimate = ReportFit(answer.fit, answer.judged, input.measurements);
  estimate.options = input.options.changed();

  // how the samples were prepared, of fits at constant speed
  const bool steady = identifier.regime == Regime::steady && !input.measurements.acceleration;
  if (steady && input.log.faults().empty()) TellPreparation(input.log, estimate);
  if (!steady && input.log.absurd()) estimate.warnings.push_back(*input.log.absurd());
  return estimate;
}

Estimate IdentifyAndJudge(const Identifier& identifier, const IdentifierInput& input,
                          const Judging& judging) {
  return ReportAnswer(identifier, input, FitAndJudge(identifier, input, judging));
}

Estimate IdentifyUnjudged(const Identifier& identifier, const IdentifierInput& given) {
  const IdentifierInput input = Seen(identifier, given);
  const Fit fit = identifier.fit(input);
  return ReportFit(fit, Infer(fit), input.measurements);
}

Estimate WithVoidNumbers(const Identifier& identifier, const IdentifierInput& input,
                         const Answer& answer) {
  Estimate shown = ReportAnswer(identifier, input, answer);

  // a verdict that voided nothing leaves nothing to force
  if (answer.judged.status == answer.inferred.status) return shown;
  Estimate before = ReportFit(answer.fit, answer.inferred, Seen(identifier, input).measurements);
  shown.parameters = std::move(before.parameters);
  shown.friction = std::move(before.friction);
  shown.bands = std::move(before.bands);
  shown.message += "; forced: all numbers are void";
  return shown;
}

}  // namespace warmjoint::inline identification
