#include "tools/figures/predicted.h"

#include <fmt/core.h>

#include "tools/figures/axes.h"
#include "tools/figures/number_text.h"

namespace warmjoint::figures {
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
                 {"median", Hue::vermilion, BinnedMedian(predicted, residuals, kBins)},
                 {"", Hue::text, LevelLine{0}}};
  plot.x = LinearAxis(TorqueLabel(view, "predicted torque"), {predicted});
  plot.y = BulkAxis(TorqueLabel(view, "measured − predicted"), {residuals});
  return plot;
}

/// What differs between the figures.
struct Words {
  std::string name, title, samples;
};

std::optional<Figure> Make(const FitView& view, const Words& words) {
  if (!view.has_fit || view.selection.count() == 0) return std::nullopt;
  // torques with their rigid part, as the sensor has them
  const Eigen::VectorXd measured = KeptOf(view, view.torque + view.rigid);
  const Eigen::VectorXd predicted = KeptOf(view, view.fitted + view.rigid);
  const Eigen::VectorXd residuals = measured - predicted;
  // one number for how far the prediction is off
  const std::string rmse =
      SignificantText(std::sqrt(residuals.array().square().mean())) + " " + view.torque_unit;
  Figure figure;
  figure.name = words.name;
  figure.title = words.title + (view.is_void() ? " (void)" : "");
  figure.subtitle = fmt::format("{}: RMSE {} over {} {}", OriginOf(view), rmse,
                                view.selection.count(), words.samples);
  figure.finding = fmt::format("Measured and predicted torque differ by {} rms.", rmse);
  // predicted over measured torque, and the residual beside it
  figure.height = 430;
  figure.columns = {1, 1};
  figure.panels = {{"", PredictedOverMeasured(view, measured, predicted), 0, 0},
                   {"", ResidualOverPredicted(view, residuals, predicted), 0, 1}};
  return figure;
}

}  // namespace

std::optional<Figure> MakePredicted(const FitView& view) {
  return Make(view, {"predicted", "Predicted against measured torque", "samples"});
}

std::optional<Figure> MakeHeldOut(const FitView& view) {
  return Make(view, {"held_out", "Predicted against measured torque, on samples that were held out",
                     "samples that this fit has not seen"});
}

}  // namespace warmjoint::figures
