#include "identification/lack_of_fit/find_lack_of_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "identification/inference/apply.h"
#include "identification/lack_of_fit/examine.h"
#include "identification/lack_of_fit/remedies.h"
#include "identification/lack_of_fit/rounding.h"
#include "identification/lack_of_fit/table.h"
#include "identification/sentences/assumptions.h"
#include "identification/sentences/heat.h"
#include "identification/sentences/lack_of_fit.h"
#include "identification/sentences/log.h"
#include "identification/sentences/moved_parameter.h"
#include "identification/uncertainty/tails.h"
#include "identification/warming/gaps.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

// of the friction, by all findings together; why: between what real logs that repeat leave, 12 % at most, and
// a constant torque taken for friction, 26 % (a study of 1,320 simulated and 35 real fits)
constexpr double kTogether = 0.25;
// s; why: no clock of a joint counts three years; stamps since 1970, which passed it in 1973, say nothing of the joint's motion
constexpr double kStamp = 1e8;

std::vector<Diagnostic> DiagnosticsOf(const Examination& examination, const Fit& fit,
                                      const std::string& unit) {
  std::vector<Diagnostic> diagnostics;
  for (const Finding& finding : examination.findings) {
    Diagnostic& one = diagnostics.emplace_back();
    one.test = finding.test->name;
    one.made = finding.made;
    // a test that was not made says why, and nothing else
    if (!finding.made) {
      one.reason = finding.reason;
      continue;
    }
    // of a p below all numbers: that of the smallest, so that a file holds a number
    one.statistic = ZOf(std::max(finding.p, std::numeric_limits<double>::min()));
    one.p = finding.p;
    one.p_adjusted = finding.p_adjusted;
    one.rejected = finding.rejected;
    one.effect = examination.Rms(finding);
    one.effect_unit = unit;
    one.moves = NamedMoves(examination.rows, finding.moves, fit);
  }
  return diagnostics;
}

/// Whether something was found whose relation to the warming is this one.
bool Finds(const Examination& examination, HeatRelation warming) {
  return std::ranges::any_of(examination.findings, [=](const Finding& finding) {
    return finding.rejected && finding.test->warming == warming;
  });
}

/// The row of a source; nullptr where there is none.
Cause* Row(Source source, Examination& examination) {
  const auto found = std::ranges::find(examination.causes, source, &Cause::source);
  return found == examination.causes.end() ? nullptr : &*found;
}

/// What was examined.
struct Examined {
  const Identifier& identifier;
  const IdentifierInput& input;
  const Fit& fit;
  const Inference& by_noise;
};

/// The parameter that a row biases most, in half widths of its interval by noise, with the bound that holds for 95 % of
/// that bias. Nothing where no bias exceeds one half width.
std::optional<MovedParameter> FarthestBeyond(const Cause& cause, const Examined& of) {
  std::optional<MovedParameter> farthest;
  double most = 1;
  for (std::size_t i = 0; i < cause.rows.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    double bias = cause.bias[at];
    if (cause.spread.size() > 0) {
      bias += std::copysign(kNormal95 * cause.spread.row(at).norm(), bias);
    }
    const double beyond = std::abs(bias) / of.by_noise.parameters[cause.rows[i]].HalfWidth();
    // without an interval there is nothing to lie beyond
    if (!std::isfinite(beyond) || beyond <= most) continue;
    most = beyond;
    farthest.emplace(MovedParameter{of.fit.parameters[cause.rows[i]], bias});
  }
  return farthest;
}

/// What a finding is about.
std::string QuantityOf(const Finding& finding, const Examined& of) {
  return finding.test->quantity(finding, of.input.measurements);
}

/// How much a finding changes the friction, for the comparison with --relevance. Where the effect of a finding understates
/// it, only half of --relevance is allowed.
double Counted(const Finding& finding) {
  return (finding.test->harm == Impact::of_effect_twice ? 2 : 1) * finding.harm;
}

/// Why the findings make the model inadequate; nothing where they do not.
std::optional<std::string> TooMuch(const Examination& examination, const Finding& worst,
                                   const LackOfFitSettings& judging, const Examined& of) {
  if (Counted(worst) > judging.relevance) {
    return ExplainTooMuch(QuantityOf(worst, of), worst.harm, judging.relevance);
  }
  double explained = 0;
  for (const Finding* finding : examination.Found()) explained += finding->explained;
  explained = std::min(explained, examination.squares);
  const double together = std::sqrt(explained / examination.samples) / examination.friction;
  if (together <= kTogether) return std::nullopt;
  return ExplainTooMuchTogether(together, kTogether);
}

/// The rows of the warming. It takes up an unknown part of a drift, so that its rows get no interval where a drift was found.
std::vector<std::size_t> RowsOfWarming(const Fit& fit) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    const Role role = fit.parameters[i].role;
    if (IsHeat(role) || role == Role::start || role == Role::jump) rows.push_back(i);
  }
  return rows;
}

/// How much the rows of findings change the friction, at the speed where they change it most, as a share of it; of an answer without
/// friction at speeds, or with findings that change all of it alike: the share of the worst, rms.
double LargestChange(const Examined& of, const Examination& examination, double worst) {
  std::vector<Cause> rows;
  for (const Cause& cause : examination.causes) {
    if (cause.source != Source::findings) continue;
    rows.push_back(cause);
    rows.back().action = Action::widen;
  }
  double largest = worst;
  for (const SpeedFigure& one : of.by_noise.at_speeds) {
    const double reach = ChangeOf(rows, one.derivatives, About::friction).reach;
    largest = std::max(largest, reach / std::abs(one.at.value));
  }
  return largest;
}

/// Adds the row of all findings: it refuses an answer that they make wrong, else it widens the intervals.
void ActOnFindings(const Examined& of, const LackOfFitSettings& judging, Examination& examination) {
  Cause* const row = Row(Source::findings, examination);
  if (!row) return;

  // the remedy for the largest finding, and the finding that changes the friction most
  const std::vector<const Finding*> found = examination.Found();
  const Advice advice{*found[0], of.identifier, of.input, of.fit};
  row->remedy = WithoutWhatWasDone(advice, found[0]->test->remedy(advice));
  const Finding& worst =
      **std::ranges::max_element(found, {}, [](const Finding* one) { return Counted(*one); });
  const auto explain = [&](const std::string& effect) {
    std::vector<FoundPart> parts;
    for (const Finding* one : found) {
      const double rms = examination.Rms(*one);
      parts.push_back({QuantityOf(*one, of), rms, 100 * rms / examination.friction,
                       100 * std::min(one->explained / examination.squares, 1.0)});
    }
    return ExplainFindings(parts, of.input.measurements.torque_unit, effect, row->remedy->Text());
  };
  if (const auto why = TooMuch(examination, worst, judging, of)) {
    row->action = Action::refuse;
    row->status = Status::inadequate_model;
    row->sentence = explain(*why);
    return;
  }

  // the warming took up an unknown part of a drift, or of a warm start
  const bool drifts = Finds(examination, HeatRelation::confounded);
  const auto widen = [&](Source source) {
    for (Cause& open : examination.causes) {
      if (open.source == source) open.action = Action::widen;
    }
  };
  if (drifts) {
    row->without_interval = RowsOfWarming(of.fit);
    widen(Source::open_drift);
  }
  if (Finds(examination, HeatRelation::starts)) widen(Source::open_start);
  const bool without_warming = drifts && of.fit.RowOf(Role::gain);
  row->sentence = explain(ExplainWidened(worst.harm, LargestChange(of, examination, worst.harm)) +
                          (without_warming ? kAbsorbedByWarming : ""));
}

/// Acts on the belief about the start. Where the start is unknown, intervals cover a warm one. Where it is taken to be
/// cold, a warning is given if a warm start would change a value beyond its interval.
void ActOnStart(const Examined& of, StartBelief start, Examination& examination) {
  Cause* const row = Row(Source::cold_start, examination);
  if (!row) return;
  if (start == StartBelief::unknown) {
    row->action = Action::widen;
    row->sentence = kCoversWarmStart;
    row->sentence_in = SentenceIn::message;
  } else if (const auto moved = FarthestBeyond(*row, of)) {
    const double begins = of.input.measurements.time[0];
    const bool ran_before = begins != 0 && begins < kStamp;
    row->sentence = ExplainColdStart(*moved, ran_before ? std::optional(begins) : std::nullopt,
                                     RemedyForWarmStart(of.identifier));
  }
}

/// Whether a longer recording shows more of what a test looks for. It does not where the structure occurs only once.
bool Recurs(const LackOfFitTest& test) {
  return test.warming != HeatRelation::starts && &test != FindLackOfFitTest("step");
}

/// Sentences about what the log does not determine, in the order in which they are read; of steps and unadjusted findings only
/// where they leave an interval.
void ExplainLog(const Examined& of, Examination& examination) {
  const LogSamples& m = of.input.measurements;
  if (Cause* const row = Row(Source::held_losses, examination)) {
    const auto tau = std::ranges::find(row->rows, *of.fit.RowOf(Role::time_constant));
    row->sentence =
        ExplainHeldLosses(MedianStep(m.time), row->bias[tau - row->rows.begin()], row->action);
  }
  if (Cause* const row = Row(Source::gaps, examination)) {
    row->sentence = ExplainGaps(FindGaps(m), m.time, row->action);
  }
  for (const Source source : {Source::rounding, Source::hidden_steps}) {
    Cause* const row = Row(source, examination);
    const auto moved = row ? FarthestBeyond(*row, of) : std::nullopt;
    if (!moved) continue;
    row->sentence = ExplainRounding(StepOf(m.torque), m.torque_unit, *moved, row->action);
    row->sentence_in = SentenceIn::any_answer;
  }
  // one sentence for all, with the finding that biases a parameter most
  std::vector<std::string> quantities;
  bool recurs = true;
  for (const Finding* one : examination.FoundUnadjusted()) {
    quantities.push_back(QuantityOf(*one, of));
    recurs = recurs && Recurs(*one->test);
  }
  Cause* said = nullptr;
  std::optional<MovedParameter> farthest;
  for (Cause& row : examination.causes) {
    if (row.source != Source::unadjusted_findings) continue;
    const auto moved = FarthestBeyond(row, of);
    const auto size = [&](const MovedParameter& one) {
      return std::abs(one.change / one.parameter.value);
    };
    if (!moved || (farthest && size(*moved) <= size(*farthest))) continue;
    said = &row;
    farthest.emplace(*moved);
  }
  if (said) said->sentence = ExplainUnadjusted(quantities, *farthest, recurs ? kLongerTells : "");
}

}  // namespace

LackOfFit FindLackOfFit(const Identifier& identifier, const IdentifierInput& input, const Fit& fit,
                        const Inference& by_noise, const std::optional<FittedModel>& model,
                        const LackOfFitSettings& judging) {
  const std::string& unit = input.measurements.torque_unit;
  // a fit that is not ok has nothing to examine
  if (by_noise.status != Status::ok) {
    Examination none;
    none.findings = NotMade(ExplainNotExamined(StatusName(by_noise.status)));
    return {DiagnosticsOf(none, fit, unit), {}};
  }
  Examination examination = ExamineResidual(model, fit, by_noise, input.measurements);
  const Examined of{identifier, input, fit, by_noise};
  ActOnStart(of, judging.start, examination);
  ExplainLog(of, examination);
  ActOnFindings(of, judging, examination);
  return {DiagnosticsOf(examination, fit, unit), std::move(examination.causes)};
}

}  // namespace warmjoint
