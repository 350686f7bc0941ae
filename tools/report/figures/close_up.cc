#include <algorithm>
#include <cmath>
#include <tuple>

#include "tools/report/figures/axes.h"
#include "tools/report/figures/fit_panels.h"

namespace warmjoint::report {
namespace {

Eigen::VectorXd Part(const Eigen::VectorXd& all, const Window& window) {
  return all.segment(window.begin, window.end - window.begin);
}

/// Samples in a twelfth of the recording, for those with few segments.
Eigen::Index ShortSpan(const FitView& view) {
  return std::max<Eigen::Index>(std::min<Eigen::Index>(view.time.size(), 3), view.time.size() / 12);
}

}  // namespace

Window ColdWindow(const FitView& view, int segments) {
  const auto& all = view.selection.segments;
  if (all.size() < 2 * static_cast<std::size_t>(segments)) return {0, ShortSpan(view)};
  return {all.front().begin, all[static_cast<std::size_t>(segments) - 1].end};
}

Window WarmWindow(const FitView& view, int segments) {
  const auto& all = view.selection.segments;
  const Eigen::Index n = view.time.size();
  if (all.size() < 2 * static_cast<std::size_t>(segments)) return {n - ShortSpan(view), n};
  return {all[all.size() - static_cast<std::size_t>(segments)].begin, all.back().end};
}

std::pair<double, double> TorqueLimits(const FitView& view, const Window& a, const Window& b) {
  // accelerations may leave the picture: constant speeds are what is looked at
  const Eigen::VectorXd kept = KeptOrGap(view, view.torque);
  auto [lower, upper] = RangeOf({Part(kept, a), Part(kept, b)});
  if (!std::isfinite(lower))
    std::tie(lower, upper) = RangeOf({Part(view.torque, a), Part(view.torque, b)});
  const Axis axis = LinearAxis("", {Eigen::Vector2d(lower, upper)});
  const double spare = 0.08 * (upper - lower);
  return {axis.lower - spare, axis.upper + spare};
}

Plot CloseUp(const FitView& view, const Window& window, const std::pair<double, double>& limits) {
  const Eigen::VectorXd time = Part(view.time, window) / TimeUnit(view);
  Plot plot;
  plot.series.push_back({"measured", Hue::grey, Line{time, Part(view.torque, window), 2.0}});
  if (view.has_fit) {
    const Eigen::VectorXd fitted = Part(KeptOrGap(view, view.fitted), window);
    plot.series.push_back({"fit at the kept samples", Hue::blue, Line{time, fitted, 1.0}});
  }
  plot.x = {TimeLabel(view), time[0], time.tail(1)[0], Scale::linear, {}};
  plot.y = {TorqueLabel(view, "torque"), limits.first, limits.second, Scale::linear, {}};
  return plot;
}

}  // namespace warmjoint::report
