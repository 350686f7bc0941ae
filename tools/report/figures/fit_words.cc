// What a fit says, in words and in a table.
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "tools/report/draw/ticks.h"
#include "tools/report/figures/fit_panels.h"

namespace warmjoint::report {
namespace {

constexpr double kMemory = 0.3;  // correlation that is worth a word

/// So many digits that the deviation has two.
std::string WithDigitsOf(double value, std::optional<double> deviation) {
  if (!deviation || !(*deviation > 0) || value == 0) return SignificantText(value, 4);
  const double digits =
      std::floor(std::log10(std::abs(value))) - std::floor(std::log10(*deviation)) + 2;
  return SignificantText(value, static_cast<int>(std::clamp(digits, 2.0, 7.0)));
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

/// With a capital letter and a full stop.
std::string Sentence(std::string text) {
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text.ends_with('.') ? text : text + '.';
}

}  // namespace

std::string VerdictSentence(const FitView& view) {
  return fmt::format("{}: {}", view.estimate.identifier, PlainVerdict(view.estimate.status));
}

Words VerdictOf(const FitView& view) {
  const Estimate& estimate = view.estimate;
  const Hue hue = estimate.status == Status::ok ? Hue::green : Hue::vermilion;
  Words words;
  words.paragraphs.push_back({VerdictSentence(view) + ".", true, hue});
  if (!estimate.message.empty()) words.paragraphs.push_back({Sentence(estimate.message)});
  if (estimate.metrics) {
    words.paragraphs.push_back({MetricsSentence(*estimate.metrics, view.torque_unit) + "."});
  }
  if (estimate.holdout) {
    words.paragraphs.push_back(
        {"Held out: " + MetricsSentence(*estimate.holdout, view.torque_unit) + "."});
  }
  const double share =
      static_cast<double>(view.selection.count()) / static_cast<double>(view.time.size());
  words.paragraphs.push_back(
      {fmt::format("{:.0f} % of the {} samples are at a constant speed and kept.", 100 * share,
                   view.time.size())});
  if (estimate.gravity) {
    words.paragraphs.push_back({"Gravity is taken off the torque that is shown."});
  }
  const double memory = view.has_fit ? ResidualCorrelation(view, 1) : 0;
  if (memory > kMemory) {
    words.paragraphs.push_back(
        {fmt::format("Residuals are alike from one sample to the next (correlation {:.2f}): "
                     "something in the torque is not in the model.",
                     memory)});
  }
  return words;
}

Table ParametersOf(const FitView& view) {
  Table table{{{"parameter", "value", "95 % interval", "unit"}}};
  for (const EstimatedParameter& parameter : view.estimate.parameters) {
    table.rows.push_back({parameter.name, WithDigitsOf(parameter.value, parameter.std),
                          IntervalText(parameter), UnitText(parameter.unit)});
  }
  return table;
}

}  // namespace warmjoint::report
