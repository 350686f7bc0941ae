#include "identification/answer/identify.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "identification/lack_of_fit/judge.h"
#include "identification/preparation/moving_view.h"
#include "identification/report/report_fit.h"
#include "identification/report/tell_preparation.h"
#include "identification/seen_samples.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

constexpr Eigen::Index kFewest = 30;  // why 30: of fewer, colour and structure of noise stay unseen
constexpr double kLeastShare = 0.05;  // why: the rest, 19 times as much, may be another motion
constexpr double kWorse = 10.8;  // why: chi-squared of one degree of freedom, once in a thousand

/// Voids an answer that is worthless whatever the tests let pass: it rests on next to nothing of the log, or one
/// number, the mean of the torque, follows it better beyond chance.
void JudgeFloor(const Fit& fit, const Measurements& m, Inference& judged) {
  const auto used = static_cast<double>(fit.torque.size());
  const auto moving = static_cast<double>((m.velocity.array().abs() > ClearSpeed(m)).count());
  if (used < kFewest || used < kLeastShare * moving) {
    judged.Void(
        Status::not_identifiable,
        fmt::format("the fit rests on {} of {} samples that move, and takes {} and {:.0f} % of "
                    "them: record longer, or use the others (--motion {})",
                    used, moving, kFewest, 100 * kLeastShare, m.acceleration ? "constant" : "any"));
    return;
  }
  const double left = fit.residual().squaredNorm();
  const double by_mean = (fit.torque.array() - fit.torque.mean()).square().sum();
  if (left - by_mean <= kWorse * judged.known.noise.variance_inflation * left / used) return;
  judged.Void(
      Status::inadequate_model,
      fmt::format("the torque's mean follows it better than the friction does (Fit {:.3g} %): "
                  "is there gravity (--gravity sincos), or a wrong sign or unit?",
                  100 * (1 - std::sqrt(left / by_mean))));
}

}  // namespace

Answer FitAndJudge(const Identifier& identifier, const IdentifierInput& given,
                   const Judging& judging) {
  const IdentifierInput input = Seen(identifier, given);

  // fit, then infer
  Answer answer;
  answer.fit = AtBounds(identifier.fit(input), input.measurements);
  answer.inferred = Infer(answer.fit);

  // judge
  answer.judged = answer.inferred;
  const std::vector<std::string>& faults = input.log.faults();
  if (faults.empty()) {
    JudgeLackOfFit(identifier, input, answer.fit, judging, answer.judged);
    if (answer.judged.status == Status::ok) {
      JudgeFloor(answer.fit, input.measurements, answer.judged);
    }
  } else {
    answer.judged.Void(Status::bad_data, fmt::format("{}", fmt::join(faults, "; and ")));
  }
  return answer;
}

Estimate ReportAnswer(const Identifier& identifier, const IdentifierInput& given,
                      const Answer& answer) {
  const IdentifierInput input = Seen(identifier, given);
  Estimate estimate = ReportFit(answer.fit, answer.judged, input.measurements);
  estimate.options = input.options.Changed();

  // how the samples were prepared, of fits at constant speed
  const bool steady = identifier.regime == Regime::steady && !input.measurements.acceleration;
  if (steady && input.log.faults().empty()) TellPreparation(input.log, estimate);
  if (input.measurements.position_integrated) estimate.warnings.emplace_back(kNoPositions);
  if (!steady && input.log.absurd()) estimate.warnings.push_back(*input.log.absurd());
  return estimate;
}

Estimate IdentifyAndJudge(const Identifier& identifier, const IdentifierInput& input,
                          const Judging& judging) {
  return ReportAnswer(identifier, input, FitAndJudge(identifier, input, judging));
}

Estimate IdentifyUnjudged(const Identifier& identifier, const IdentifierInput& given) {
  const IdentifierInput input = Seen(identifier, given);
  const Fit fit = AtBounds(identifier.fit(input), input.measurements);
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

}  // namespace warmjoint
