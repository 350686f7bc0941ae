// The trace of an identifier that iterates.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "identification/fit_parameters.h"
#include "models/friction/thermal.h"
#include "tools/figures/axes.h"
#include "tools/figures/estimate_figures.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
namespace {

constexpr std::size_t kFewSteps = 12;  // up to which every iteration gets a mark

/// One number over the iterations.
Plot CurveOf(const Eigen::VectorXd& iteration, const Eigen::VectorXd& values, Hue hue,
             const std::string& label) {
  Plot plot;
  plot.series.push_back({"", hue, Line{iteration, values, 2}});
  if (static_cast<std::size_t>(iteration.size()) <= kFewSteps) {
    plot.series.push_back({"", hue, Scatter{iteration, values, 3}});
  }
  plot.x = IterationAxis(iteration[0], iteration.tail(1)[0]);
  plot.y = LinearAxis(label, {values});
  return plot;
}

/// The final interval as a band behind the trace.
void AddInterval(Plot& plot, const EstimatedParameter& parameter, Hue hue) {
  if (!parameter.interval95) return;
  const auto [lower, upper] = *parameter.interval95;
  const Eigen::Vector2d across(plot.x.lower, plot.x.upper);
  plot.series.insert(plot.series.begin(), Series{"final 95 % interval", hue,
                                                 Band{across, Eigen::Vector2d::Constant(lower),
                                                      Eigen::Vector2d::Constant(upper)}});
  // the axis widens until the whole interval is seen
  const Axis with = LinearAxis("", {Eigen::Vector4d(lower, upper, plot.y.lower, plot.y.upper)});
  if (lower < plot.y.lower || upper > plot.y.upper) {
    plot.y.lower = with.lower;
    plot.y.upper = with.upper;
  }
}

Eigen::VectorXd ValuesOf(const Estimate& estimate, const std::string& name) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(estimate.trace.size()));
  for (std::size_t k = 0; k < estimate.trace.size(); ++k) {
    const auto& parameters = estimate.trace[k].parameters;
    const auto found = std::find_if(parameters.begin(), parameters.end(),
                                    [&](const auto& entry) { return entry.first == name; });
    values[static_cast<Eigen::Index>(k)] = found == parameters.end() ? std::nan("") : found->second;
  }
  return values;
}

/// The names as laws and warming list their parameters; others behind them.
std::vector<std::string> InOrderOfTheLaw(const TraceEntry& entry) {
  std::vector<std::string> names;
  for (const auto& [name, value] : entry.parameters) {
    // the discrete ones of warming say what gain and time constant say
    if (name != kDiscreteGainName && name != kPoleName) names.push_back(name);
  }
  std::stable_sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    return PlaceInLaws(a) < PlaceInLaws(b);
  });
  return names;
}

/// " (N·m)", the unit of its torques; nothing where no parameter tells.
std::string TorqueUnitIn(const Estimate& estimate) {
  const EstimatedParameter* level = Find(LawPart::level, estimate);
  return level ? fmt::format(" ({})", UnitText(level->unit)) : "";
}

}  // namespace

std::optional<Figure> MakeTrace(const Estimate& estimate, const std::string& what) {
  const auto steps = static_cast<Eigen::Index>(estimate.trace.size());
  if (steps < 2) return std::nullopt;
  // iterations, with the error of the fit after each
  Eigen::VectorXd iteration(steps), rmse(steps);
  for (Eigen::Index k = 0; k < steps; ++k) {
    iteration[k] = estimate.trace[static_cast<std::size_t>(k)].iteration;
    rmse[k] = estimate.trace[static_cast<std::size_t>(k)].rmse;
  }

  // three panels to a row
  constexpr double kRow = 200;  // points
  Figure figure = WithoutPanels(
      {"trace", fmt::format("Parameters by iteration: {}", estimate.identifier), what, ""}, 3);

  // a panel for each parameter, with the interval that it ended with
  const Hue hue = IdentifierHue(estimate.identifier);
  figure.finding = "From the first iteration to the last:";
  for (const std::string& name : InOrderOfTheLaw(estimate.trace.back())) {
    const Eigen::VectorXd values = ValuesOf(estimate, name);
    const EstimatedParameter* parameter = estimate.Find(name);
    // numbers without a dimension have the unit 1
    const bool has_unit = parameter && parameter->unit != "1";
    const std::string unit = has_unit ? fmt::format(" ({})", UnitText(parameter->unit)) : "";
    Plot plot = CurveOf(iteration, values, hue, SymbolOf(name) + unit);
    if (parameter) AddInterval(plot, *parameter, hue);
    AddPanel(figure, NameWithSymbol(name), plot, kRow);
    figure.finding += fmt::format(" {} {} to {},", name, SignificantText(values[0]),
                                  SignificantText(values[steps - 1]));
  }
  // last how the error of the fit falls
  Plot error = CurveOf(iteration, rmse, hue, "RMSE" + TorqueUnitIn(estimate));
  error.y = MagnitudeAxis(error.y.label, {rmse});
  AddPanel(figure, "Root mean square error of the fit", error, kRow);
  figure.finding.back() = '.';
  return figure;
}

}  // namespace warmjoint::figures
