#include "identification/lack_of_fit/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "identification/lack_of_fit/report_findings.h"
#include "identification/lack_of_fit/rounding.h"
#include "identification/lack_of_fit/table.h"
#include "identification/lack_of_fit/words.h"
#include "identification/uncertainty/between_ends.h"
#include "identification/warming/gaps.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr double kSure = 5;      // deviations of the heat's share from a value that is ruled out
constexpr double kSureMove = 3;  // deviations from which a move is there; why 3: 1 in 370
// of the friction, by all findings together; why: between what real logs that repeat leave, 12 % at most, and
// a constant torque taken for friction, 26 % (a study of 1,320 simulated and 35 real fits)
constexpr double kTogether = 0.25;

/// Whether something was found that may stand in the warming in that way.
bool Finds(const Examination& examination, HeatRelation warming) {
  return std::ranges::any_of(examination.findings, [=](const Finding& finding) {
    return finding.rejected && finding.test->warming == warming;
  });
}

/// What drifts is partly taken up by the warming, by how much cannot be known: no interval of it is
/// left.
void DropWarming(const Fit& fit, Inference& inference) {
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const Role role = fit.parameters[i].role;
    if (role != Role::heat && role != Role::start) continue;
    inference.parameters[i].std.reset();
    inference.parameters[i].interval95.reset();
  }
}

/// Lets intervals reach as far as something moves the parameters. by: [p]
void Widen(const Examination& examination, const Eigen::VectorXd& by, Inference& inference) {
  for (size_t i = 0; i < examination.rows.size(); ++i) {
    inference.Widen(examination.rows[i], by[static_cast<Index>(i)]);
  }
}

/// Moves the parameters with their intervals. by: [p]
void Shift(const Examination& examination, const Eigen::VectorXd& by, Inference& inference) {
  for (size_t i = 0; i < examination.rows.size(); ++i) {
    KnownParameter& known = inference.parameters[examination.rows[i]];
    const double move = by[static_cast<Index>(i)];
    known.value += move;
    if (!known.interval95) continue;
    for (double& end : *known.interval95) end += move;
  }
}

/// Lets intervals hold parameters as they are, and as something would move them. by: [p]
void HoldBoth(const Examination& examination, const Eigen::VectorXd& by, Inference& inference) {
  for (size_t i = 0; i < examination.rows.size(); ++i) {
    KnownParameter& known = inference.parameters[examination.rows[i]];
    const double move = by[static_cast<Index>(i)];
    known.widened += std::abs(move);
    if (!known.interval95 || !(known.HalfWidth() > 0)) continue;
    // noise around either end: an interval that holds the one that is true
    auto& [lower, upper] = *known.interval95;
    const double half = known.HalfWidth(), middle = 0.5 * (lower + upper);
    const double reach = half * ReachBeyondEnds(kNormal95 * std::abs(move) / half) / kNormal95;
    lower = middle + std::min(move, 0.0) - reach;
    upper = middle + std::max(move, 0.0) + reach;
  }
}

/// Where the log's step matters to the warming: the parameters of heat that is followed within the
/// steps where the residual tells that it is; where it cannot tell, intervals that hold both.
void FollowHeat(const Examination& examination, const Fit& fit, const Measurements& m,
                Inference& inference) {
  if (examination.by_heat.size() == 0) return;
  const double share = examination.heat_share, sure = kSure * examination.heat_deviation;
  const double fits = kSureMove * examination.heat_deviation;
  // the residual tells that losses are held over each step, as the fit has them
  if (1 - share > sure && std::abs(share) < fits) return;
  const auto tau = std::ranges::find(examination.rows, *fit.RowOf(Role::heat, 1));
  const std::string what = fmt::format(
      "Eq. (22) takes the losses as constant within each step of {:.3g} s; losses that change with "
      "the heat within a step change thermal_time_constant by {:.2g} s",
      MedianStep(m.time), examination.by_heat[tau - examination.rows.begin()]);

  // it tells that they follow the heat: the numbers become theirs; else both are possible
  if (share > sure && std::abs(1 - share) < fits) {
    inference.warnings.push_back(
        fmt::format("{}, and describe the log better: the numbers given are theirs", what));
    Shift(examination, examination.by_heat, inference);
  } else {
    inference.warnings.push_back(fmt::format("{}: the intervals cover both; log faster", what));
    HoldBoth(examination, examination.by_heat, inference);
  }
}

/// Lets intervals reach as far as the gaps of the log may have moved the parameters.
void WidenByGaps(const Examination& examination, const Measurements& m, Inference& inference) {
  if (examination.by_gaps.size() == 0) return;
  inference.warnings.push_back(
      fmt::format("{}: the losses during that time are unknown, and intervals were widened to "
                  "cover this; record without gaps",
                  DescribeGaps(FindGaps(m), m)));
  Widen(examination, examination.by_gaps, inference);
}

/// The parameter that something moves farthest, in half widths of its interval, where that is
/// beyond one; -1 where there is none. by: [p]
Index FarthestBeyond(const Eigen::VectorXd& by, const Examination& examination,
                     const Inference& inference) {
  Index worst = -1;
  double most = 1;
  for (Index i = 0; i < by.size(); ++i) {
    const size_t row = examination.rows[static_cast<size_t>(i)];
    const double beyond = std::abs(by[i]) / inference.parameters[row].HalfWidth();
    // without an interval there is nothing to lie beyond
    if (!std::isfinite(beyond) || beyond <= most) continue;
    most = beyond;
    worst = i;
  }
  return worst;
}

/// Takes back what the steps of the torque do to the parameters, or lets intervals hold what they hide.
void CorrectRounding(const Examination& examination, const Fit& fit, const Measurements& m,
                     Inference& inference) {
  const bool hides = examination.by_steps.size() > 0;
  const Eigen::VectorXd& by = hides ? examination.by_steps : examination.by_rounding;
  const Index worst = FarthestBeyond(by, examination, inference);
  hides ? Widen(examination, by, inference) : Shift(examination, by, inference);
  if (worst < 0) return;
  const FitParameter& parameter = fit.parameters[examination.rows[static_cast<size_t>(worst)]];
  inference.warnings.push_back(fmt::format(
      "the torque comes in steps of {:.3g} {}, which its noise does not even out: {} {} by {:.2g} "
      "{}; log the torque in finer steps",
      StepOf(m.torque), m.torque_unit,
      hides ? "intervals were widened to cover what they hide, that of"
            : "the numbers given are free of what they do,",
      parameter.name + (hides ? "" : " changed"), by[worst], parameter.unit));
}

/// What the start does to the numbers: intervals that hold a warm one too, or a warning of how far
/// it would move a parameter beyond its interval.
void WeighStart(const Examination& examination, const Identifier& identifier,
                const IdentifierInput& input, const Fit& fit, const Judging& judging,
                Inference& inference) {
  const Index worst = FarthestBeyond(examination.by_start, examination, inference);

  // of a start that is not known, intervals cover a warm one
  if (judging.start == StartBelief::unknown && examination.by_start.size() > 0) {
    inference.message +=
        "; the intervals also cover a start at a tenth of the warmth that the joint reaches";
    Widen(examination, examination.by_start, inference);
    return;
  }

  // of one that is taken to be cold, a warning where a warm one would leave an interval
  if (worst < 0) return;
  const FitParameter& parameter = fit.parameters[examination.rows[static_cast<size_t>(worst)]];
  const double begins = input.measurements.time[0];
  const std::string clock =
      begins == 0
          ? ""
          : fmt::format(" (its clock begins at {:.4g} s: had the joint moved before?)", begins);
  const double change = examination.by_start[worst];
  inference.warnings.push_back(
      fmt::format("this assumes a cold start{}: had the joint been 10 % warmed up, {} would be "
                  "{:.2g} {} {}; {}",
                  clock, parameter.name, std::abs(change), parameter.unit,
                  change < 0 ? "lower" : "higher", AgainstWarmStart(identifier)));
}

/// What the residual depends on, in the order of size: a clause.
std::string Depends(const Examination& examination, const Measurements& measurements) {
  std::vector<std::string> words;
  for (const Finding* finding : examination.Found()) {
    words.push_back(DescribeFinding(examination, *finding, measurements));
  }
  return fmt::format("the residual depends on {}", fmt::join(words, "; and on "));
}

/// Lets intervals hold what one test by itself would call lack of fit, and the log, where many are made, does not: a
/// parameter that a real one moved is not given as sure, and none is refused for chance.
void CoverHints(const Examination& examination, const Fit& fit, const Measurements& m,
                Inference& inference) {
  // the farthest move is looked for before the intervals reach it
  const Index worst = FarthestBeyond(examination.by_hints, examination, inference);
  Widen(examination, examination.by_hints, inference);
  if (worst < 0) return;
  std::vector<std::string> words;
  for (const Finding* hint : examination.Hints()) words.push_back(hint->test->quantity(*hint, m));
  const FitParameter& parameter = fit.parameters[examination.rows[static_cast<size_t>(worst)]];
  inference.warnings.push_back(fmt::format(
      "the residual may depend on {}: one test alone would call that found, among many it may be "
      "chance; intervals were widened to cover it, that of {} by {:.2g} {}; a longer recording "
      "tells",
      fmt::join(words, ", or on "), parameter.name, examination.by_hints[worst], parameter.unit));
}

/// How far a finding changes the friction, beside --relevance: half of that is allowed of what moves understate.
double Counted(const Finding& finding) {
  return (finding.test->harm == Harm::of_either_twice ? 2 : 1) * finding.harm;
}

/// Why what was found is too much to live with, and what helps; nothing where it is not.
std::optional<std::string> TooMuch(const Examination& examination, const Finding& worst,
                                   const Judging& judging, const Measurements& m) {
  if (Counted(worst) > judging.relevance) {
    return fmt::format("modelling {} would change the friction by {:.2g} % (--relevance {:.3g})",
                       worst.test->quantity(worst, m), 100 * worst.harm, judging.relevance);
  }
  double explained = 0;
  for (const Finding* finding : examination.Found()) explained += finding->explained;
  explained = std::min(explained, examination.squares);
  const double together = std::sqrt(explained / examination.samples) / examination.friction;
  if (together <= kTogether) return std::nullopt;
  return fmt::format("all of that is {:.2g} % of the friction, more than {:.2g} %", 100 * together,
                     100 * kTogether);
}

/// Voids an inference that lack of fit makes wrong, or warns of it and widens the intervals.
void WeighFindings(const Examination& examination, const Identifier& identifier,
                   const IdentifierInput& input, const Fit& fit, const Judging& judging,
                   Inference& inference) {
  // what helps against the largest, and which changes the friction most
  const std::vector<const Finding*> found = examination.Found();
  const std::string remedy = found[0]->test->remedy({*found[0], identifier, input, fit});
  const Finding& worst =
      **std::ranges::max_element(found, {}, [](const Finding* one) { return Counted(*one); });
  const std::string depends = Depends(examination, input.measurements);
  if (const auto why = TooMuch(examination, worst, judging, input.measurements)) {
    inference.Void(Status::inadequate_model, fmt::format("{}; {}; {}", depends, *why, remedy));
    return;
  }

  // small: the intervals hold it
  const bool drifts = Finds(examination, HeatRelation::confounded);
  const bool unknown = drifts && fit.RowOf(Role::heat);
  inference.warnings.push_back(fmt::format(
      "{}: it changes the friction by {:.2g} % at most; intervals were widened to cover this{}; {}",
      depends, 100 * worst.harm,
      unknown ? ", and the parameters of warming have none, since they may have absorbed part of it"
              : "",
      remedy));
  // nobody knows how much of a drift the warming took up
  if (drifts) {
    DropWarming(fit, inference);
    Widen(examination, examination.by_open_drift, inference);
  }
  // nor how much of a warm start
  if (Finds(examination, HeatRelation::starts) && examination.by_open_start.size() > 0) {
    Widen(examination, examination.by_open_start, inference);
  }
  // intervals reach as far as the findings move the parameters, with 95 % of that
  Eigen::VectorXd reach = examination.moves.cwiseAbs() + kNormal95 * examination.move_deviations;
  if (examination.by_hidden.size() > 0) reach += examination.by_hidden;
  Widen(examination, reach, inference);
}

}  // namespace

void JudgeLackOfFit(const Identifier& identifier, const IdentifierInput& input, const Fit& fit,
                    const Judging& judging, Inference& inference) {
  const Measurements& m = input.measurements;
  // a fit that is not ok has nothing to examine
  if (inference.status != Status::ok) {
    Examination none;
    none.findings = NotMade(fmt::format("the fit is {}", StatusName(inference.status)));
    inference.diagnostics = DiagnosticsOf(none, fit, m.torque_unit);
    return;
  }

  // examine
  const Examination examination = ExamineResidual(fit, inference, m, input.selection);
  inference.diagnostics = DiagnosticsOf(examination, fit, m.torque_unit);
  inference.assumptions = AssumptionsOf(examination, fit, m.torque_unit);

  // and weigh
  WeighStart(examination, identifier, input, fit, judging, inference);
  FollowHeat(examination, fit, m, inference);
  WidenByGaps(examination, m, inference);
  if (examination.by_rounding.size() + examination.by_steps.size() > 0)
    CorrectRounding(examination, fit, m, inference);
  if (!examination.Found().empty()) {
    WeighFindings(examination, identifier, input, fit, judging, inference);
  }
  if (inference.status == Status::ok && examination.by_hints.size() > 0) {
    CoverHints(examination, fit, m, inference);
  }
}

}  // namespace warmjoint
