// What an estimate says of a recording against what was measured.
#include <fmt/core.h>

#include <tuple>
#include <vector>

#include "tools/figures/axes.h"
#include "tools/figures/estimate_figures.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
namespace {

constexpr int kBins = 40;

/// Samples of one direction. The torques, [n], count along the motion: friction has one sign, and fills the plane.
struct Direction {
  const char* name;
  Hue hue;
  Eigen::VectorXd measured, predicted;
};

/// Forwards and backwards, each where there are samples. Torques have their rigid part, as the sensor has them.
std::vector<Direction> DirectionsOf(const FitView& view) {
  const Eigen::VectorXd velocity = KeptOf(view, view.velocity);
  const Eigen::VectorXd measured = KeptOf(view, view.torque + view.rigid);
  const Eigen::VectorXd predicted = KeptOf(view, view.fitted + view.rigid);
  std::vector<Direction> directions;
  for (const auto& [sign, name, hue] :
       {std::tuple(1, "forwards", Hue::blue), std::tuple(-1, "backwards", Hue::vermilion)}) {
    std::vector<Eigen::Index> at;
    for (Eigen::Index i = 0; i < velocity.size(); ++i) {
      if ((velocity[i] < 0) == (sign < 0)) at.push_back(i);
    }
    if (!at.empty()) directions.push_back({name, hue, sign * measured(at), sign * predicted(at)});
  }
  return directions;
}

Plot PredictedOverMeasured(const FitView& view, const std::vector<Direction>& directions) {
  Plot plot;
  std::vector<Eigen::VectorXd> shown;
  for (const Direction& one : directions) {
    plot.series.push_back({one.name, one.hue, Scatter{one.measured, one.predicted, 1.1}});
    shown.insert(shown.end(), {one.measured, one.predicted});
  }
  const auto [lowest, highest] = RangeOf(shown);
  const Eigen::Vector2d ends(lowest, highest);
  plot.series.push_back({"equal", Hue::text, Line{ends, ends, 1.2, Dash::dashed}});
  plot.x = LinearAxis(TorqueLabel(view, "measured · sign(v)"), {ends});
  plot.y = LinearAxis(TorqueLabel(view, "predicted · sign(v)"), {ends});
  return plot;
}

Plot ResidualOverPredicted(const FitView& view, const std::vector<Direction>& directions) {
  Plot plot;
  std::vector<Eigen::VectorXd> predicted, residuals;
  for (const Direction& one : directions) {
    predicted.push_back(one.predicted);
    residuals.push_back(one.measured - one.predicted);
    plot.series.push_back({"", Hue::grey, Scatter{predicted.back(), residuals.back(), 1.1}});
  }
  // medians above the samples of both
  for (std::size_t i = 0; i < directions.size(); ++i) {
    plot.series.push_back({std::string("median ") + directions[i].name, directions[i].hue,
                           BinnedMedian(predicted[i], residuals[i], kBins)});
  }
  plot.series.push_back({"", Hue::text, LevelLine{0}});
  plot.x = LinearAxis(TorqueLabel(view, "predicted · sign(v)"), predicted);
  plot.y = BulkAxis(TorqueLabel(view, "residual · sign(v)"), residuals);
  return plot;
}

/// samples: what the figure calls them.
std::optional<Figure> Make(const FitView& view, const std::string& name, const std::string& title,
                           const std::string& samples) {
  if (!view.has_fit || view.selection.count() == 0) return std::nullopt;
  const std::vector<Direction> directions = DirectionsOf(view);
  const Eigen::VectorXd residuals = Residuals(view);
  // one number for how far the prediction is off
  const std::string rmse =
      SignificantText(std::sqrt(residuals.array().square().mean())) + " " + view.torque_unit;
  // predicted over measured torque, and the residual beside it
  return RowOfPlots(
      {name, title + (view.is_void() ? " (void)" : ""),
       fmt::format("{}: RMSE {} over {} {}", OriginOf(view), rmse, view.selection.count(), samples),
       fmt::format("Measured and predicted torque differ by {} rms.", rmse)},
      430,
      {{"", PredictedOverMeasured(view, directions)},
       {"", ResidualOverPredicted(view, directions)}});
}

}  // namespace

std::optional<Figure> MakePredicted(const FitView& view) {
  return Make(view, "predicted", "Predicted against measured torque", "samples");
}

std::optional<Figure> MakeHeldOut(const FitView& view) {
  return Make(view, "held_out", "Predicted against measured torque, on samples that were held out",
              "samples that this fit has not seen");
}

}  // namespace warmjoint::figures
