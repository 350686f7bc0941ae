#include "tools/report/figures/predicted.h"

#include <fmt/core.h>

#include "tools/report/draw/ticks.h"
#include "tools/report/figures/axes.h"
#include "tools/report/figures/binned_mean.h"

namespace warmjoint::report {
namespace {

constexpr int kBins = 40;

Plot PredictedOverMeasured(const FitView& view, const Eigen::VectorXd& measured,
                           const Eigen::VectorXd& predicted) {
  const auto [lowest, highest] = RangeOf({measured, predicted});
  const Eigen::Vector2d ends(lowest, highest);
  Plot plot;
  plot.series = {{"samples", Hue::grey, Scatter{measured, predicted, 1.1}},
                 {"equal", Hue::text, Line{ends, ends, 1.2, Dash::dashed}}};
  plot.x = LinearAxis(TorqueLabel(view, "measured torque"), {ends});
  plot.y = LinearAxis(TorqueLabel(view, "predicted torque"), {ends});
  return plot;
}

Plot ResidualOverPredicted(const FitView& view, const Eigen::VectorXd& residuals,
                           const Eigen::VectorXd& predicted) {
  Plot plot;
  plot.series = {{"samples", Hue::grey, Scatter{predicted, residuals, 1.1}},
                 {"mean", Hue::vermilion, BinnedMean(predicted, residuals, kBins)},
                 {"", Hue::text, LevelLine{0}}};
  plot.x = LinearAxis(TorqueLabel(view, "predicted torque"), {predicted});
  plot.y = LinearAxis(TorqueLabel(view, "measured − predicted"), {residuals});
  return plot;
}

}  // namespace

std::optional<Figure> MakePredicted(const FitView& view) {
  if (!view.has_fit || view.selection.count() == 0) return std::nullopt;
  const Eigen::VectorXd measured = KeptOf(view, view.torque), predicted = KeptOf(view, view.fitted);
  const Eigen::VectorXd residuals = measured - predicted;
  const std::string rmse =
      SignificantText(std::sqrt(residuals.array().square().mean())) + " " + view.torque_unit;
  Figure figure;
  figure.name = "predicted";
  figure.title = view.is_void() ? "Predicted against measured torque (void)"
                                : "Predicted against measured torque";
  figure.subtitle =
      fmt::format("{}: RMSE {} over {} samples", OriginOf(view), rmse, view.selection.count());
  figure.finding = fmt::format("Measured and predicted torque differ by {} rms.", rmse);
  figure.height = 430;
  figure.columns = {1, 1};
  figure.panels = {{"", PredictedOverMeasured(view, measured, predicted), 0, 0},
                   {"", ResidualOverPredicted(view, residuals, predicted), 0, 1}};
  return figure;
}

}  // namespace warmjoint::report
