#include "identification/answer/identify.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "identification/answer/floors.h"
#include "identification/answer/settling.h"
#include "identification/answer/speed_figures.h"
#include "identification/fit/fit_along.h"
#include "identification/fit/seen_samples.h"
#include "identification/forward/log_trajectory.h"
#include "identification/identifiers/model_comparison.h"
#include "identification/identifiers/structures.h"
#include "identification/inference/apply.h"
#include "identification/inference/bounds.h"
#include "identification/lack_of_fit/find_lack_of_fit.h"
#include "identification/report/report_fit.h"
#include "identification/sentences/assumptions.h"
#include "identification/sentences/lack_of_fit.h"
#include "identification/sentences/late_torque.h"
#include "identification/sentences/log.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

constexpr double kHarmless = 1e-3;      // attenuation
constexpr double kHarmfulDelay = 0.01;  // of the friction; why: intervals may be as narrow as that
constexpr double kUnresolvedPath = 5e-3;  // share of the path

/// The first row of the law that is a slope over speed; nullptr where there is none.
const Unknown* SlopeOf(const Fit& fit) {
  for (const Unknown& row : fit.parameters) {
    if (row.role == Role::law && row.part == LawPart::slope) return &row;
  }
  return nullptr;
}

/// Whether maps have a slope over speed: those over speed, and those that are multiplied by it.
bool MapsSlope(const Fit& fit) {
  return std::ranges::any_of(fit.model.friction.maps, [](const FrictionMap& map) {
    return FindAxis(map, MapQuantity::velocity) || map.factor == MapFactor::velocity;
  });
}

/// The effect of what averaging left of the noise: an error of a slope biases the levels by that error times the mean speed.
Cause VelocityNoiseCause(const VelocityNoise& taken, const Fit& fit, const Unknown* viscous,
                         std::string_view slope) {
  Cause cause{.source = Source::velocity_noise,
              .action = Action::widen,
              .sentence = ExplainVelocityNoise(taken, slope)};
  if (!viscous) return cause;
  const double move = std::abs(taken.left * viscous->value);
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    const Unknown& row = fit.parameters[i];
    const bool is_level = row.part == LawPart::level;
    if (row.role != Role::law || !(is_level || row.part == LawPart::slope)) continue;
    // a slope that is too small goes with levels that are too large
    cause.Add(i, is_level ? -move * taken.mean_speed : move);
  }
  return cause;
}

/// What was done to the velocity.
void AddVelocity(const VelocityNoise& taken, JointKind joint, const Fit& fit,
                 std::vector<Cause>& causes) {
  const Unknown* const viscous = SlopeOf(fit);
  std::string slope = MapsSlope(fit) ? kSlopesOverSpeed : "";
  if (viscous) slope = viscous->name;
  causes.push_back({.source = Source::velocity_averaged,
                    .sentence = ExplainAveraging(taken, joint, slope),
                    .sentence_in = SentenceIn::message});
  if (!slope.empty() && taken.left > kHarmless) {
    causes.push_back(VelocityNoiseCause(taken, fit, viscous, slope));
  }
}

Cause OfTheLog(Source source, std::string sentence) {
  return {.source = source, .sentence = std::move(sentence), .sentence_in = SentenceIn::any_answer};
}

/// Rows about the preparation of the log. For fits at constant speed: where more than 0.1 % of a slope's attenuation by noise
/// of the velocity is left, intervals of viscous and of the levels are widened by the bias from that; of a warming, how far the
/// gain may be off where reversals happen between two samples, unless that is below half a per cent. For all fits: units that
/// may be others, positions that the log lacks, and torque that was left out as absurd. input: what the identifier saw;
/// by_noise: of the fit.
std::vector<Cause> PreparationCauses(const IdentifierInput& input, const Fit& fit,
                                     const Inference& by_noise) {
  std::vector<Cause> causes;
  const PreparedLog& log = input.log;
  const bool steady = input.view == View::constant_speed;
  if (steady && log.faults().empty()) {
    const bool warms = fit.RowOf(Role::gain) && !by_noise.parameters.empty();
    if (warms && log.unresolved_path() >= kUnresolvedPath) {
      causes.push_back(OfTheLog(Source::reversals, ExplainReversals(log.unresolved_path())));
    }
    for (const std::string& warning : log.warnings()) {
      causes.push_back(OfTheLog(Source::preparation, warning));
    }
    if (log.velocity_noise()) {
      AddVelocity(*log.velocity_noise(), log.raw().measurements.joint, fit, causes);
    }
  }
  for (const std::string& doubt : input.measurements.doubts) {
    causes.push_back(OfTheLog(Source::recording, doubt));
  }
  if (input.measurements.position_integrated) {
    causes.push_back(OfTheLog(Source::recording, kNoPositions));
  }
  if (!steady && log.faults().empty() && input.view == View::moving) {
    for (const std::string& warning : log.moving_warnings()) {
      causes.push_back(OfTheLog(Source::preparation, warning));
    }
  }
  if (!steady && log.absurd()) causes.push_back(OfTheLog(Source::recording, *log.absurd()));
  return causes;
}

// why: structure that a fit to unsettled torque hides shows in the next
constexpr int kMostRounds = 3;

/// The fit to samples at which the torque has settled: the segments lose their first seconds as long as the residual shows that
/// the torque had not settled there.
struct SettledFit {
  Fit fit;
  Settling settling{};                         // of all rounds
  std::shared_ptr<const Selection> samples{};  // the samples of the fit, where some had not settled
  // the fit with the samples of the run in which what is left fades away
  std::optional<Fit> sooner{};
};

SettledFit FitSettled(const Identifier& identifier, const IdentifierInput& input) {
  const Eigen::VectorXd& time = input.measurements.time;
  const auto without = [&](const Settling& settling) {
    return std::make_shared<const Selection>(WithoutSettling(input.selection, time, settling));
  };
  const auto fit_to = [&](const Selection& samples) {
    return WithoutNegativeInertia(identifier.fit, input.With(samples));
  };
  SettledFit settled{fit_to(input.selection)};
  Fit plain;  // to all samples
  Settling earlier, more;
  for (int round = 0; round < kMostRounds && !settled.fit.refusal; ++round) {
    const Fit& fit = settled.fit;
    // a view that is not the input's has other samples, and rows of means have none of their own
    const bool same =
        fit.rows.used.keep.size() == time.size() && fit.rows.torque.size() == fit.rows.used.count();
    if (input.view != View::constant_speed || !same) break;
    const Settling found = SettlingTime(fit.rows.used, time, fit.rows.residual());
    if (found.both() == 0) break;
    // structure that takes longer is something else, which the tests for lack of fit look for
    if (!MaySettle(settled.settling + found, input.selection, time)) {
      return {settled.samples ? std::move(plain) : std::move(settled.fit)};
    }
    if (!settled.samples) plain = fit;
    earlier = settled.settling;
    more = found;
    settled.settling = earlier + more;
    const auto samples = without(settled.settling);
    settled.fit = fit_to(*samples);
    settled.samples = samples;
  }
  if (settled.samples) settled.sooner = fit_to(*without(earlier + more * kShownToSettle));
  return settled;
}

/// What is left of a torque that settles biases law and heat by no more than the samples in which it fades away do. Why: of an
/// exponential, and of what fades quicker, less is left after these samples than within them.
Cause SettlingCause(const SettledFit& settled) {
  const double longest = std::max(settled.settling.after, settled.settling.before);
  Cause cause = OfTheLog(Source::preparation, ExplainSettling(longest));
  const std::vector<Unknown>& rows = settled.fit.parameters;
  const bool alike = settled.sooner && !settled.sooner->refusal && !settled.fit.refusal &&
                     settled.sooner->model.friction.law == settled.fit.model.friction.law &&
                     settled.sooner->parameters.size() == rows.size();
  if (!alike) return cause;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].estimated || (rows[i].role != Role::law && !IsHeat(rows[i].role))) continue;
    cause.Add(i, settled.sooner->parameters[i].value - rows[i].value);
  }
  cause.action = Action::widen;
  return cause;
}

/// The row of a delay of the torque that a fit to motion of any kind does not hold: refuses where that changes the friction too
/// much, else says so.
std::optional<Cause> DelayCause(const Identifier& identifier, const IdentifierInput& input,
                                const Fit& fit) {
  // an identifier that can estimate a delay, or that chose among those that can, has no such row: it found no delay, or its
  // options say that there is none
  if (fit.choice) return {};
  Structure asked{identifier};
  asked.identifier.options = input.options;
  if (fit.model.delay || asked.CanEstimateDelay()) return {};
  const auto late = FindLateTorque(input);
  if (!late) return {};
  const bool refuses = late->harm > kHarmfulDelay;
  return Cause{.source = Source::late_torque,
               .action = refuses ? Action::refuse : Action::note,
               .status = refuses ? Status::inadequate_model : Status::ok,
               .sentence = ExplainDelayLeftOut(late->delay, MedianStep(input.measurements.time),
                                               late->harm, identifier.name)};
}

/// Why a fit without gravity failed, where its identifier has that option and the weight of the joint explains most of the
/// torque that a law leaves. Nothing where it does not, or the fit did not fail.
std::optional<Cause> GravityCause(const Identifier& identifier, const IdentifierInput& input,
                                  const Answer& answer) {
  const auto* option = input.options.Find<GravityOption>();
  const Status status = answer.inferred.status;
  const bool failed = status != Status::ok && status != Status::bad_data;
  if (!failed || !option || option->gravity != FittedGravity::none) return std::nullopt;
  if (!ShowsWeight(input)) return std::nullopt;
  return Cause{.source = Source::weight,
               .action = Action::refuse,
               .status = status,
               .sentence = ExplainWeight(identifier.name)};
}

/// The motion that a fit's torque follows, where that is not the input's.
std::optional<LogView> FollowedOf(const Fit& fit, const IdentifierInput& input) {
  return Followed(input.measurements, input.selection, PartsOf(fit));
}

/// The causes that log and fit give, and the tests as data. Enters the friction at speeds with its intervals by noise.
LackOfFit FindCauses(const Identifier& identifier, const IdentifierInput& input,
                     const LackOfFitSettings& judging, Answer& answer) {
  LackOfFit found;
  const std::vector<std::string> faults = input.log.faults();
  if (!faults.empty()) {
    found.causes.push_back({.source = Source::faults,
                            .action = Action::refuse,
                            .status = Status::bad_data,
                            .sentence = ExplainFaults(faults)});
  } else {
    // the motion that the model follows
    const auto followed = FollowedOf(answer.fit, input);
    const IdentifierInput seen = followed ? input.On(*followed) : input;
    std::optional<FittedModel> model;
    if (answer.inferred.status == Status::ok) {
      model = EvaluateModel(answer.fit, answer.inferred, seen.measurements, seen.selection);
    }
    answer.by_noise.at_speeds =
        SpeedFiguresOf(answer.fit, answer.inferred, model, seen.measurements, seen.selection);
    answer.inferred.at_speeds = answer.by_noise.at_speeds;
    found = FindLackOfFit(identifier, seen, answer.fit, answer.inferred, model, judging);
    if (answer.inferred.status == Status::ok && !IsRefused(found.causes)) {
      auto floor = FloorCause(answer.fit, seen.measurements, answer.by_noise, judging.relevance);
      if (floor) found.causes.push_back(std::move(*floor));
      auto late_torque = DelayCause(identifier, input, answer.fit);
      if (late_torque) found.causes.push_back(std::move(*late_torque));
    }
  }
  std::ranges::move(PreparationCauses(input, answer.fit, answer.inferred),
                    std::back_inserter(found.causes));
  return found;
}

/// The answer with all causes applied; of a refused one also what it was before.
Inference Judged(const Answer& answer, std::vector<Cause> causes) {
  Inference judged = Apply(answer.by_noise, std::move(causes));
  if (judged.status != answer.inferred.status) {
    judged.refused = std::make_shared<const Inference>(answer.inferred);
  }
  return judged;
}

}  // namespace

IdentifierInput InputOf(const Answer& answer, const Identifier& identifier,
                        const IdentifierInput& given) {
  const IdentifierInput input = SelectSamples(identifier, given);
  return answer.settled ? input.With(*answer.settled) : input;
}

Answer FitAndCheck(const Identifier& identifier, const IdentifierInput& given,
                   const LackOfFitSettings& judging) {
  Answer answer;
  SettledFit settled = FitSettled(identifier, SelectSamples(identifier, given));
  answer.settling = settled.settling;
  answer.settled = settled.samples;
  std::optional<Cause> unsettled;
  if (settled.samples) unsettled = SettlingCause(settled);
  answer.fit = std::move(settled.fit);
  const IdentifierInput input = InputOf(answer, identifier, given);
  NameOneSpeed(input.measurements, input.selection, answer.fit);
  answer.by_noise = ByNoise(answer.fit);
  std::vector<Cause> causes = OwnCauses(answer.fit, answer.by_noise);
  answer.inferred = Apply(answer.by_noise, causes);
  if (auto weight = GravityCause(identifier, input, answer)) {
    causes.push_back(*std::move(weight));
  }

  // the other causes; the last floor looks at the friction that remains after all of them
  LackOfFit found = FindCauses(identifier, input, judging, answer);
  std::ranges::move(found.causes, std::back_inserter(causes));
  if (unsettled) causes.push_back(*std::move(unsettled));
  if (answer.inferred.status == Status::ok && !IsRefused(causes)) {
    auto unknown = UnknownFriction(answer.by_noise.at_speeds, causes);
    if (unknown) causes.push_back(std::move(*unknown));
  }
  answer.judged = Judged(answer, std::move(causes));
  answer.judged.diagnostics = std::move(found.diagnostics);
  answer.judged.assumptions =
      AssumptionsOf(answer.judged.causes, answer.fit, input.measurements.torque_unit);
  return answer;
}

void JudgeHeldOut(const HeldOut& held_out, Answer& answer) {
  if (answer.judged.status != Status::ok) return;
  auto floor = FloorOfHeldOut(held_out, answer.fit);
  if (!floor) return;
  std::vector<Cause> causes = answer.judged.causes;
  causes.push_back(std::move(*floor));
  Inference judged = Judged(answer, std::move(causes));
  judged.diagnostics = std::move(answer.judged.diagnostics);
  judged.assumptions = std::move(answer.judged.assumptions);
  answer.judged = std::move(judged);
}

Estimate ReportAnswer(const Identifier& identifier, const IdentifierInput& given,
                      const Answer& answer, RefusedNumbers numbers) {
  const IdentifierInput input = SelectSamples(identifier, given);
  Estimate estimate = ReportFit(answer.fit, answer.judged, input.log, input.measurements, numbers);
  estimate.options = input.options.Changed();
  if (answer.settling.both() > 0) estimate.settling = answer.settling;
  return estimate;
}

Estimate IdentifyAndCheck(const Identifier& identifier, const IdentifierInput& input,
                          const LackOfFitSettings& judging) {
  return ReportAnswer(identifier, input, FitAndCheck(identifier, input, judging));
}

Estimate IdentifyUnchecked(const Identifier& identifier, const IdentifierInput& given) {
  const IdentifierInput input = SelectSamples(identifier, given);
  Fit fit = WithoutNegativeInertia(identifier.fit, input);
  NameOneSpeed(input.measurements, input.selection, fit);
  Inference by_noise = ByNoise(fit);
  const std::vector<Cause> causes = OwnCauses(fit, by_noise);
  const Inference inferred = Apply(by_noise, causes);
  const auto followed = FollowedOf(fit, input);
  const LogSamples& m = followed ? followed->measurements : input.measurements;
  const Selection& selection = followed ? followed->selection : input.selection;
  by_noise.at_speeds =
      SpeedFiguresOf(fit, inferred, EvaluateModel(fit, inferred, m, selection), m, selection);
  return ReportFit(fit, Apply(std::move(by_noise), causes), input.log, m);
}

}  // namespace warmjoint
