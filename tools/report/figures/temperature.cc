#include "tools/report/figures/temperature.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "identification/report/heat_beside_temperature.h"
#include "tools/report/draw/ticks.h"
#include "tools/report/figures/axes.h"

namespace warmjoint::report {
namespace {

/// A row of the comparison; nothing where it is not there.
const EstimatedParameter* Find(const Estimate& estimate, std::string_view name) {
  const auto found = std::ranges::find(estimate.temperature, name, &EstimatedParameter::name);
  return found == estimate.temperature.end() ? nullptr : &*found;
}

/// The line T0 + b E.
struct HeatLine {
  Eigen::VectorXd energy;       // [N] E, behind by the thermometer's lag
  Eigen::VectorXd temperature;  // [N] degC; each recording with its own T0
};

HeatLine LineOf(const FitView& view, double slope, double lag) {
  HeatLine line{Lagged(view.energy, lag, view.course.time, view.course.starts), {}};
  line.temperature = slope * line.energy;
  // each part of the recording has a base temperature of its own
  std::vector<Eigen::Index> bounds = view.course.starts;
  bounds.insert(bounds.begin(), 0);
  bounds.push_back(view.time.size());
  for (size_t i = 0; i + 1 < bounds.size(); ++i) {
    const Eigen::Index begin = bounds[i], count = bounds[i + 1] - begin;
    // line and temperature have the same mean over the part
    const double base = view.temperature.segment(begin, count).mean() -
                        line.temperature.segment(begin, count).mean();
    line.temperature.segment(begin, count).array() += base;
  }
  return line;
}

Plot OverTime(const FitView& view, const std::string& label, std::vector<Series> series,
              const std::vector<Eigen::VectorXd>& shown) {
  Plot plot;
  plot.x = {TimeLabel(view), 0, view.time.tail(1)[0] / TimeUnit(view), Scale::linear, {}};
  plot.y = LinearAxis(label, shown);
  plot.series = std::move(series);
  return plot;
}

Plot OneOverTheOther(const FitView& view, const HeatLine& line, const std::string& energy) {
  Plot plot;
  plot.series = {{"samples", Hue::grey, Scatter{line.energy, view.temperature, 1.1}},
                 {"T_{0} + b E", Hue::blue, Scatter{line.energy, line.temperature, 0.7}}};
  plot.x = LinearAxis(TorqueLabel(view, energy), {line.energy});
  plot.y = LinearAxis("temperature (°C)", {view.temperature, line.temperature});
  return plot;
}

/// "−0.98 (−0.99 to −0.95)"
std::string WithInterval(const EstimatedParameter& row) {
  const std::string value = SignificantText(row.value);
  if (!row.interval95) return value + " (too little of the log is independent to say how surely)";
  return fmt::format("{} ({} to {})", value, SignificantText((*row.interval95)[0]),
                     SignificantText((*row.interval95)[1]));
}

}  // namespace

std::optional<Figure> MakeTemperature(const FitView& view) {
  // the estimate has to say how the temperature follows the heat
  const EstimatedParameter* correlation = Find(view.estimate, "correlation");
  const EstimatedParameter* slope = Find(view.estimate, "per_energy");
  const EstimatedParameter* lag = Find(view.estimate, "lag");
  if (!view.warms() || !correlation || !slope || !lag) return std::nullopt;
  if (view.temperature.size() == 0) return std::nullopt;
  const HeatLine line = LineOf(view, slope->value, lag->value);
  const Eigen::VectorXd time = view.time / TimeUnit(view);
  const std::string energy =
      lag->value > 0 ? fmt::format("E, {} s behind", SignificantText(lag->value)) : "E";

  // what the two have in common, said with care
  Figure figure;
  figure.name = "temperature";
  figure.title = "The heat of the fit beside the temperature";
  figure.subtitle = OriginOf(view) + "; the fit does not use the temperature";
  figure.finding = fmt::format(
      "Temperature and E have a correlation of {} and go with {} {}. Both may follow something "
      "else.",
      WithInterval(*correlation), SignificantText(slope->value), UnitText(slope->unit));
  // heat and temperature over time at the left, one over the other at the right
  figure.height = 520;
  figure.rows = {1, 1};
  figure.columns = {1.25, 1};
  // the first two over the time of the recording, so that they can be read together
  figure.panels = {
      {"",
       OverTime(view, TorqueLabel(view, "change of the level, E"),
                {{"", Hue::vermilion, Line{time, view.energy, 1.8}}}, {view.energy}),
       0, 0},
      {"",
       OverTime(view, "temperature (°C)",
                {{"measured", Hue::grey, Line{time, view.temperature, 1.4}},
                 {"T_{0} + b E", Hue::blue, Line{time, line.temperature, 1.6, Dash::dashed}}},
                {view.temperature, line.temperature}),
       1, 0},
      {"", OneOverTheOther(view, line, energy), 0, 1, 2, 1}};
  return figure;
}

}  // namespace warmjoint::report
