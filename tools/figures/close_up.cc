#include <algorithm>
#include <cmath>
#include <tuple>

#include "tools/figures/axes.h"
#include "tools/figures/fit_panels.h"

namespace warmjoint::figures {
namespace {

Eigen::VectorXd Part(const Eigen::VectorXd& all, const Window& window) {
  return all.segment(window.begin, window.end - window.begin);
}

/// Samples in a twelfth of the recording, for those with few segments.
Eigen::Index ShortSpan(const FitView& view) {
  return std::max<Eigen::Index>(std::min<Eigen::Index>(view.time.size(), 3), view.time.size() / 12);
}

/// Segments of a window: so many, or half of few.
std::size_t CountOf(std::size_t all, int wanted) {
  return std::clamp<std::size_t>(all / 2, 1, static_cast<std::size_t>(wanted));
}

/// A twentieth more at either end, where the recording has it: what was left out shows.
Window Around(const FitView& view, Eigen::Index begin, Eigen::Index end) {
  const Eigen::Index spare = (end - begin) / 20;
  return {std::max<Eigen::Index>(0, begin - spare), std::min(view.time.size(), end + spare)};
}

}  // namespace

Window ColdWindow(const FitView& view, int segments) {
  const auto& all = view.selection.segments;
  if (all.empty()) return {0, ShortSpan(view)};
  const std::size_t count = CountOf(all.size(), segments);
  return Around(view, all.front().begin, all[count - 1].end);
}

Window WarmWindow(const FitView& view, int segments) {
  const auto& all = view.selection.segments;
  const Eigen::Index n = view.time.size();
  if (all.empty()) return {n - ShortSpan(view), n};
  const std::size_t count = CountOf(all.size(), segments);
  return Around(view, all[all.size() - count].begin, all.back().end);
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
  // the kept samples over all of them
  const Eigen::VectorXd kept = Part(KeptOrGap(view, view.torque), window);
  plot.series.push_back({IsOfAnyMotion(view) ? "kept: moves clearly" : "kept: at constant speed",
                         Hue::sky, Line{time, kept, 2.0}});
  // the fit only where it was asked of the samples
  if (view.has_fit) {
    const Eigen::VectorXd fitted = Part(KeptOrGap(view, view.fitted), window);
    plot.series.push_back({FitLabel(view), Hue::vermilion, Line{time, fitted, 1.2, FitDash(view)}});
  }
  // torque limits are shared with the other close-ups
  plot.x = {TimeLabel(view), time[0], time.tail(1)[0], Scale::linear, {}};
  plot.y = {TorqueLabel(view, "torque"), limits.first, limits.second, Scale::linear, {}};
  return plot;
}

}  // namespace warmjoint::figures
