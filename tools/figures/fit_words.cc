// What a fit says, in words and in a table.
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <vector>

#include "tools/figures/fit_panels.h"
#include "tools/figures/shown_estimate.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
namespace {

constexpr double kMemory = 0.3;  // correlation that is worth a word

/// So many digits that the deviation has two.
std::string WithDigitsOf(double value, std::optional<double> deviation) {
  if (!deviation || !(*deviation > 0) || value == 0) return SignificantText(value, 4);
  if (!std::isfinite(value) || !std::isfinite(*deviation)) return SignificantText(value, 4);
  const double digits =
      std::floor(std::log10(std::abs(value))) - std::floor(std::log10(*deviation)) + 2;
  return SignificantText(value, static_cast<int>(std::clamp(digits, 2.0, 6.0)));
}

std::string IntervalText(const EstimatedParameter& parameter) {
  if (!parameter.interval95) return "–";
  return fmt::format("{} … {}", WithDigitsOf((*parameter.interval95)[0], parameter.std),
                     WithDigitsOf((*parameter.interval95)[1], parameter.std));
}

const char* PlainVerdict(Status status) {
  switch (status) {
    case Status::ok:
      return "the numbers can be used";
    case Status::not_converged:
      return "the search did not settle: do not use the numbers";
    case Status::not_identifiable:
      return "this motion cannot tell the parameters apart: there are no numbers to use";
    case Status::inadequate_model:
      return "the model does not describe these data: do not use the numbers";
    case Status::bad_data:
      return "these data cannot be used";
  }
  return "";
}

std::string MetricsSentence(const Metrics& metrics, const std::string& unit) {
  return fmt::format("Fit {:.1f} %, RMSE {} {}, MAE {} {}, {} samples", metrics.fit,
                     SignificantText(metrics.rmse), unit, SignificantText(metrics.mae), unit,
                     metrics.n);
}

/// As set in print: with a capital letter, a full stop, and units that no line break parts.
std::string Sentence(std::string text) {
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  for (std::size_t at; (at = text.find("N.m")) != std::string::npos;) text.replace(at, 3, "N·m");
  return text.ends_with('.') ? text : text + '.';
}

/// What a reader must know before using numbers that passed: warnings of the identifier, and
/// residuals with a memory. Empty where the verdict is a failure, which says it all.
std::vector<std::string> WarningsOf(const FitView& view) {
  if (view.estimate.status != Status::ok) return {};
  std::vector<std::string> warnings = view.estimate.warnings;
  // a residual that goes on from sample to sample has a cause
  const double memory = view.has_fit ? ResidualCorrelation(view, 1) : 0;
  if (memory > kMemory) {
    warnings.push_back(
        fmt::format("residuals are alike from one sample to the next (correlation {:.2f}): "
                    "something in the torque is not in the model",
                    memory));
  }
  return warnings;
}

}  // namespace

std::string VerdictSentence(const FitView& view) {
  const std::size_t warnings = WarningsOf(view).size();
  const std::string beside = warnings == 0   ? ""
                             : warnings == 1 ? ", with a warning"
                                             : fmt::format(", with {} warnings", warnings);
  return fmt::format("{}: {}{}", view.estimate.identifier, PlainVerdict(view.estimate.status),
                     beside);
}

Words VerdictOf(const FitView& view) {
  const Estimate& estimate = view.estimate;
  const bool passed = estimate.status == Status::ok;
  const std::vector<std::string> warnings = WarningsOf(view);
  // green where the numbers can be used, red where they are void
  const Hue hue = !passed ? Hue::vermilion : warnings.empty() ? Hue::green : Hue::caution;
  Words words;
  // the verdict first, then what to beware of
  words.paragraphs.push_back({VerdictSentence(view) + ".", true, hue});
  for (const std::string& warning : warnings) {
    words.paragraphs.push_back({"Warning: " + Sentence(warning), false, Hue::caution});
  }
  // the reason in the words of the estimate
  const std::string message = passed ? estimate.message : estimate.FullMessage();
  if (!message.empty()) words.paragraphs.push_back({Sentence(message)});
  // how well it fits the samples that it saw, and others
  if (estimate.metrics) {
    words.paragraphs.push_back({MetricsSentence(*estimate.metrics, view.torque_unit) + "."});
  }
  if (estimate.holdout) {
    words.paragraphs.push_back(
        {"Held out: " + MetricsSentence(*estimate.holdout, view.torque_unit) + "."});
  }
  if (!estimate.without_holdout.empty()) {
    words.paragraphs.push_back({"No held-out figures: " + Sentence(estimate.without_holdout)});
  }
  // how much of the recording was used
  const double share =
      static_cast<double>(view.selection.count()) / static_cast<double>(view.time.size());
  words.paragraphs.push_back(
      {fmt::format("{:.0f} % of the {} samples {} and are kept.", 100 * share, view.time.size(),
                   IsOfAnyMotion(view) ? "move clearly" : "move at a constant speed")});
  // what was taken off the torque before it is shown
  if (const std::string taken = TakenOff(view); !taken.empty()) {
    words.paragraphs.push_back(
        {Sentence(fmt::format("the torque that is shown is less {}", taken))});
  }
  return words;
}

Table ParametersOf(const FitView& view) {
  Table table{{{"parameter", "value", "95 % interval", "unit"}}};
  for (const EstimatedParameter& parameter : ShownParameters(view.estimate)) {
    table.rows.push_back({NameWithSymbol(parameter.name),
                          WithDigitsOf(parameter.value, parameter.std), IntervalText(parameter),
                          UnitText(parameter.unit)});
  }
  return table;
}

}  // namespace warmjoint::figures
