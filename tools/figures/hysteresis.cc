#include "tools/figures/hysteresis.h"

#include "tools/figures/axes.h"
#include "tools/figures/fit_panels.h"

namespace warmjoint::figures {
namespace {

constexpr int kSegments = 4;  // a loop, and a reversal on either side

Eigen::VectorXd Part(const Eigen::VectorXd& all, const Window& window) {
  return all.segment(window.begin, window.end - window.begin);
}

bool GoesBothWays(const FitView& view) {
  const Eigen::VectorXd kept = KeptOf(view, view.velocity);
  return kept.size() > 0 && kept.minCoeff() < 0 && kept.maxCoeff() > 0;
}

/// Torque over position within a window. limits: of the torque.
Plot Loop(const FitView& view, const Window& window, const std::pair<double, double>& limits) {
  const Eigen::VectorXd position = Part(view.position, window);
  Plot plot;
  plot.series = {{"measured", Hue::grey, Line{position, Part(view.torque, window), 1.4}}};
  // the fit has gaps where samples were left out
  if (view.has_fit) {
    const Eigen::VectorXd fitted = Part(KeptOrGap(view, view.fitted), window);
    plot.series.push_back(
        {FitLabel(view), Hue::vermilion, Line{position, fitted, 1.6, FitDash(view)}});
  }
  plot.x = LinearAxis(PositionLabel(view), {position});
  plot.y = {TorqueLabel(view, "torque"), limits.first, limits.second, Scale::linear, {}};
  return plot;
}

}  // namespace

std::optional<Figure> MakeHysteresis(const FitView& view) {
  if (!GoesBothWays(view)) return std::nullopt;
  // the first and the last segments back and forth, over the same torques
  const Window first = ColdWindow(view, kSegments), last = WarmWindow(view, kSegments);
  const auto limits = TorqueLimits(view, first, last);
  Figure figure;
  figure.name = "hysteresis";
  figure.title = "Torque over position, back and forth";
  const std::string taken = TakenOff(view);
  figure.subtitle = OriginOf(view) + (taken.empty() ? "" : "; the torque is less " + taken);
  figure.finding =
      "The height of the loop is twice the friction; from the first to the last it changes by what "
      "the joint has warmed.";
  // both loops beside each other
  figure.height = 400;
  figure.columns = {1, 1};
  // a log without segments has its begin and its end
  const bool any = view.selection.segments.empty();
  figure.panels = {{any ? "The begin" : "First segments", Loop(view, first, limits), 0, 0},
                   {any ? "The end" : "Last segments", Loop(view, last, limits), 0, 1}};
  return figure;
}

}  // namespace warmjoint::figures
