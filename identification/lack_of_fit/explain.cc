#include "identification/lack_of_fit/explain.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "identification/lack_of_fit/remedies.h"
#include "identification/lack_of_fit/rounding.h"
#include "identification/lack_of_fit/table.h"
#include "identification/warming/gaps.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

/// The place in a row's list of the parameter that it moves farthest, in half widths of its interval by noise, where that is
/// beyond one; nothing where there is none.
std::optional<std::size_t> FarthestBeyond(const Cause& cause, const Inference& by_noise) {
  std::optional<std::size_t> worst;
  double most = 1;
  for (std::size_t i = 0; i < cause.rows.size(); ++i) {
    const double half = by_noise.parameters[cause.rows[i]].HalfWidth();
    const double beyond = std::abs(cause.bias[static_cast<Eigen::Index>(i)]) / half;
    // without an interval there is nothing to lie beyond
    if (!std::isfinite(beyond) || beyond <= most) continue;
    most = beyond;
    worst = i;
  }
  return worst;
}

double BiasOf(const Cause& cause, std::size_t i) {
  return cause.bias[static_cast<Eigen::Index>(i)];
}

/// "position (period 0.0025 m): 1.3 N rms, 3.2 % of the friction, 54 % of the residual's variance".
std::string Describe(const Examination& examination, const Finding& finding,
                     const LogSamples& measurements) {
  const double rms = examination.Rms(finding);
  const double share = 100 * std::min(finding.explained / examination.squares, 1.0);
  return fmt::format(
      "{}: {:.3g} {} rms, {:.2g} % of the friction, {:.{}f} % of the residual's variance",
      finding.test->quantity(finding, measurements), rms, measurements.torque_unit,
      100 * rms / examination.friction, share, share < 0.95 ? 1 : 0);
}

/// An assumption as estimate.json has it. meaning: with a place for its size and the torque's unit
struct AssumptionWords {
  Source source;
  const char* meaning;
};

constexpr AssumptionWords kAssumptions[] = {
    {Source::cold_start,
     "the joint was cold at the start, not at a tenth of the warmth that it reaches"},
    {Source::open_start,
     "the joint was cold at the start, though for all that this log tells E(0) may be {:.2g} {}"},
    {Source::slow_drift, "nothing outside of the model changed the friction by 1 % over the log"},
    {Source::open_drift,
     "nothing outside of the model changed the friction slowly, though this log cannot rule it "
     "out"},
    {Source::open_curve,
     "friction depends on the speed as the law has it, though this log cannot rule out that it "
     "bends"},
    {Source::open_memory,
     "friction follows the speed at once, though this log cannot rule out that a part of it is "
     "late"},
    {Source::dead_band,
     "the torque's sensor has no dead band, though one of {:.2g} {} would stay unseen"},
    {Source::degrees, "positions and speeds are in radians, not both in degrees"},
    {Source::clock, "the clock of the log is right, not off by 1 %"},
};

}  // namespace

std::string ExplainColdStart(const Cause& cause, const Explained& of) {
  const auto worst = FarthestBeyond(cause, of.by_noise);
  if (!worst) return "";
  const FitParameter& parameter = of.fit.parameters[cause.rows[*worst]];
  const double begins = of.input.measurements.time[0], change = BiasOf(cause, *worst);
  const std::string clock =
      begins == 0
          ? ""
          : fmt::format(" (its clock begins at {:.4g} s: had the joint moved before?)", begins);
  return fmt::format(
      "this assumes a cold start{}: had the joint been 10 % warmed up, {} would be {:.2g} {} {}; "
      "{}",
      clock, parameter.name, std::abs(change), parameter.unit, change < 0 ? "lower" : "higher",
      RemedyForWarmStart(of.identifier));
}

std::string ExplainHeldLosses(const Cause& cause, const Explained& of) {
  const auto tau = std::ranges::find(cause.rows, *of.fit.RowOf(Role::heat, 1));
  const std::string what = fmt::format(
      "Eq. (22) takes the losses as constant within each step of {:.3g} s; losses that change with "
      "the heat within a step change thermal_time_constant by {:.2g} s",
      MedianStep(of.input.measurements.time), cause.bias[tau - cause.rows.begin()]);
  return what + (cause.action == Action::shift
                     ? ", and describe the log better: the numbers given are theirs"
                     : ": the intervals cover both; log faster");
}

std::string ExplainGaps(const LogSamples& measurements) {
  return fmt::format(
      "{}: the losses during that time are unknown, and intervals were widened to "
      "cover this; record without gaps",
      DescribeGaps(FindGaps(measurements), measurements));
}

std::string ExplainRounding(const Cause& cause, const Explained& of) {
  const auto worst = FarthestBeyond(cause, of.by_noise);
  if (!worst) return "";
  const bool hides = cause.source == Source::hidden_steps;
  const FitParameter& parameter = of.fit.parameters[cause.rows[*worst]];
  const LogSamples& m = of.input.measurements;
  return fmt::format(
      "the torque comes in steps of {:.3g} {}, which its noise does not even out: {} {} by {:.2g} "
      "{}; log the torque in finer steps",
      StepOf(m.torque), m.torque_unit,
      hides ? "intervals were widened to cover what they hide, that of"
            : "the numbers given are free of what they do,",
      parameter.name + (hides ? "" : " changed"), BiasOf(cause, *worst), parameter.unit);
}

std::string ExplainFindings(const Examination& examination, const LogSamples& measurements) {
  std::vector<std::string> words;
  for (const Finding* finding : examination.Found()) {
    words.push_back(Describe(examination, *finding, measurements));
  }
  return fmt::format("the residual depends on {}", fmt::join(words, "; and on "));
}

std::string ExplainTooMuch(const Finding& worst, double relevance, const LogSamples& measurements) {
  return fmt::format("modelling {} would change the friction by {:.2g} % (--relevance {:.3g})",
                     worst.test->quantity(worst, measurements), 100 * worst.harm, relevance);
}

std::string ExplainTooMuchTogether(double share, double most) {
  return fmt::format("all of that is {:.2g} % of the friction, more than {:.2g} %", 100 * share,
                     100 * most);
}

std::string ExplainWidened(double largest, bool without_warming) {
  return fmt::format(
      "it changes the friction by {:.2g} % at most; intervals were widened to cover this{}",
      100 * largest,
      without_warming
          ? ", and the parameters of warming have none, since they may have absorbed part of it"
          : "");
}

std::string ExplainHints(const Cause& cause, const Examination& examination, const Explained& of) {
  const auto worst = FarthestBeyond(cause, of.by_noise);
  if (!worst) return "";
  std::vector<std::string> words;
  for (const Finding* hint : examination.Hints()) {
    words.push_back(hint->test->quantity(*hint, of.input.measurements));
  }
  const FitParameter& parameter = of.fit.parameters[cause.rows[*worst]];
  return fmt::format(
      "the residual may depend on {}: one test alone would call that found, among many it may be "
      "chance; intervals were widened to cover it, that of {} by {:.2g} {}; a longer recording "
      "tells",
      fmt::join(words, ", or on "), parameter.name, BiasOf(cause, *worst), parameter.unit);
}

std::string ExplainFewSamples(double used, double moving, double fewest, double least_share,
                              bool any_motion) {
  return fmt::format(
      "the fit rests on {} of {} samples that move, and takes {} and {:.0f} % of them: record "
      "longer, or use the others (--motion {})",
      used, moving, fewest, 100 * least_share, any_motion ? "constant" : "any");
}

std::string ExplainWorseThanMean(double fit_share) {
  return fmt::format(
      "the torque's mean follows it better than the friction does (Fit {:.3g} %): is there gravity "
      "(--gravity sincos), or a wrong sign or unit?",
      fit_share);
}

std::string ExplainOwnLaw(const FitParameter& parameter, double change) {
  return fmt::format(
      "the estimate does not fit its log: the same law fits it better with {} changed by {:.3g} "
      "{}; fit again, and check units, signs and the samples that were used",
      parameter.name, change, parameter.unit);
}

std::string ExplainAveraging(const VelocityNoise& taken, JointKind joint, std::string_view slope) {
  const std::string_view unit = kVelocityUnit.For(joint);
  if (slope.empty()) {
    return fmt::format("velocity averaged over each segment, for its noise of {:.2g} {}",
                       taken.noise, unit);
  }
  return fmt::format(
      "velocity averaged over each segment, since its noise of {:.2g} {} would change {} by "
      "{:.2g} %",
      taken.noise, unit, slope, -100 * taken.attenuation);
}

std::string ExplainVelocityNoise(const VelocityNoise& taken, std::string_view slope) {
  return fmt::format(
      "the noise of the velocity may still change {} by {:.2g} %, and intervals were "
      "widened to cover this; hold each speed for longer, or log a finer position",
      slope, -100 * taken.left);
}

std::string ExplainReversals(double unseen) {
  return fmt::format(
      "reversals happen between two samples: if the drive reverses slowly, the joint "
      "travelled up to {:.1f} % less than assumed, and thermal_gain is too small by as "
      "much; log faster to see the reversals",
      100 * unseen);
}

std::vector<Assumption> AssumptionsOf(const std::vector<Cause>& causes, const Fit& fit,
                                      const std::string& unit) {
  std::vector<Assumption> assumptions;
  for (const AssumptionWords& words : kAssumptions) {
    const auto cause = std::ranges::find(causes, words.source, &Cause::source);
    if (cause == causes.end() || cause->bias.size() == 0) continue;
    assumptions.push_back({std::string(NameOf(words.source)),
                           fmt::format(fmt::runtime(words.meaning), cause->size, unit),
                           NamedMoves(cause->rows, cause->bias, fit)});
  }
  return assumptions;
}

ParameterMoves NamedMoves(const std::vector<size_t>& rows, const Eigen::VectorXd& moves,
                          const Fit& fit) {
  ParameterMoves named;
  if (moves.size() == 0) return named;
  for (size_t i = 0; i < rows.size(); ++i) {
    named.emplace_back(fit.parameters[rows[i]].name, moves[static_cast<Eigen::Index>(i)]);
  }
  return named;
}

}  // namespace warmjoint
