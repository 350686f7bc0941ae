// Panels over the time of a recording: the level of friction, its warming, and close-ups.
#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "tools/figures/axes.h"
#include "tools/figures/fit_panels.h"
#include "tools/figures/friction_spread.h"

namespace warmjoint::figures {
namespace {

/// The kept samples of each segment as strokes of their own. values: [N].
Line SegmentLine(const FitView& view, const Eigen::VectorXd& values) {
  std::vector<double> x, y;
  for (const Segment& segment : view.selection.segments) {
    for (Eigen::Index i = segment.begin; i < segment.end; ++i) {
      if (!view.selection.keep[i]) continue;
      x.push_back(view.time[i] / TimeUnit(view));
      y.push_back(values[i]);
    }
    if (x.empty()) continue;
    // lines do not cross from one segment to the next
    x.push_back(x.back());
    y.push_back(std::nan(""));
  }
  return {VectorOf(x), VectorOf(y), 1.5, FitDash(view)};
}

/// From the lowest to the highest kept value of each segment. values: [N].
Band SegmentRanges(const FitView& view, const Eigen::VectorXd& values) {
  std::vector<double> x, lower, upper;
  const Eigen::VectorXd known = KeptOrGap(view, values);
  for (const Segment& segment : view.selection.segments) {
    // what is not kept counts for neither end
    const Eigen::Index size = segment.end - segment.begin;
    const Eigen::VectorXd own = known.segment(segment.begin, size);
    const auto [low, high] = RangeOf({own});
    if (!std::isfinite(low)) continue;
    for (double time : {view.time[segment.begin], view.time[segment.end - 1], std::nan("")}) {
      x.push_back(time / TimeUnit(view));
      lower.push_back(std::isnan(time) ? time : low);
      upper.push_back(std::isnan(time) ? time : high);
    }
  }
  return {VectorOf(x), VectorOf(lower), VectorOf(upper)};
}

constexpr double kOutermost = 0.01;  // share of the samples, at either end

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

Line SegmentMeans(const FitView& fit, const Eigen::VectorXd& values) {
  std::vector<double> x, y;
  for (const Segment& segment : fit.selection.segments) {
    // segments that kept some samples
    const auto keep = fit.selection.keep.segment(segment.begin, segment.end - segment.begin);
    if (!keep.any()) continue;
    const auto own = values.segment(segment.begin, segment.end - segment.begin).array();
    // their mean as a line from the first sample to the last
    const double mean = keep.select(own, 0).sum() / static_cast<double>(keep.count());
    for (double time : {fit.time[segment.begin], fit.time[segment.end - 1], std::nan("")}) {
      x.push_back(time / TimeUnit(fit));
      y.push_back(std::isnan(time) ? time : mean);
    }
  }
  return {VectorOf(x), VectorOf(y), 2.0};
}

Plot LevelOverTime(const FitView& view) {
  // torque in the direction of motion is the level of friction
  const Eigen::VectorXd direction = view.velocity.array().sign();
  const Eigen::VectorXd time = KeptOf(view, view.time) / TimeUnit(view);
  const Eigen::VectorXd measured = KeptOf(view, view.torque.cwiseProduct(direction));

  Plot plot;
  plot.series.push_back({"measured", Hue::grey, Scatter{time, measured, 1.1}});
  std::vector<Eigen::VectorXd> shown{measured};
  if (view.has_fit) {
    const Eigen::VectorXd level = view.fitted.cwiseProduct(direction);
    const Eigen::VectorXd fitted = KeptOf(view, level);
    // a log without segments moves all the time: its fit is dots as its samples are
    if (view.selection.segments.empty()) {
      plot.series.push_back({FitLabel(view), Hue::blue, Scatter{time, fitted, 0.9}});
    } else if (!view.estimate.friction->maps.empty()) {
      // the ripple of maps would fill the panel: its range, and its mean
      plot.series.push_back({"its range", Hue::blue, SegmentRanges(view, level)});
      plot.series.push_back(
          {FitLabel(view) + ", mean of each segment", Hue::blue, SegmentMeans(view, level)});
    } else {
      plot.series.push_back({FitLabel(view), Hue::blue, SegmentLine(view, level)});
    }
    shown.push_back(fitted);
  }
  plot.x = TimeAxis(view);
  plot.y = LinearAxis(TorqueLabel(view, "torque · sign(v)"), shown);
  return plot;
}

Plot WarmUpCurve(const FitView& view) {
  // (tau - Fn) sign v, Eq. (23), where Fn sign v = F sign v - E
  const Eigen::VectorXd direction = view.velocity.array().sign();
  const Eigen::VectorXd observed =
      KeptOf(view, (view.torque - view.fitted).cwiseProduct(direction) + view.energy);
  const Eigen::VectorXd time = view.time / TimeUnit(view);

  Plot plot;
  plot.series.push_back(
      {"(torque − F_{n}) · sign(v)", Hue::grey, Scatter{KeptOf(view, time), observed, 1.1}});
  const auto [lowest, highest] = RangeOf({observed});
  AddBand(plot, "95 %", Hue::vermilion, time, view.energy, view.energy_std, highest - lowest);
  plot.series.push_back({view.is_void() ? "E (void)" : "E", Hue::vermilion,
                         Line{time, view.energy, 2.0, FitDash(view)}});
  plot.x = TimeAxis(view);
  // samples of reversals may leave the picture, E may not
  const Axis bulk = BulkAxis("", {observed}, kOutermost);
  plot.y = LinearAxis(TorqueLabel(view, "change of the level, E"),
                      {Eigen::Vector2d(bulk.lower, bulk.upper), view.energy});
  return plot;
}

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

Axis TorqueAxis(const FitView& view, const Window& a, const Window& b) {
  // accelerations may leave the picture: constant speeds are what is looked at
  const Eigen::VectorXd kept = KeptOrGap(view, view.torque);
  auto [lower, upper] = RangeOf({a.Of(kept), b.Of(kept)});
  if (!std::isfinite(lower))
    std::tie(lower, upper) = RangeOf({a.Of(view.torque), b.Of(view.torque)});
  const Axis axis = LinearAxis("", {Eigen::Vector2d(lower, upper)});
  const double spare = 0.08 * (upper - lower);
  return {TorqueLabel(view, "torque"), axis.lower - spare, axis.upper + spare};
}

Plot CloseUp(const FitView& view, const Window& window, const Axis& torque) {
  const Eigen::VectorXd time = window.Of(view.time) / TimeUnit(view);
  Plot plot;
  plot.series.push_back({"measured", Hue::grey, Line{time, window.Of(view.torque), 2.0}});
  // the kept samples over all of them
  const Eigen::VectorXd kept = window.Of(KeptOrGap(view, view.torque));
  plot.series.push_back({IsOfAnyMotion(view) ? "kept: moves clearly" : "kept: at constant speed",
                         Hue::sky, Line{time, kept, 2.0}});
  // the fit only where it was asked of the samples
  if (view.has_fit) {
    const Eigen::VectorXd fitted = window.Of(KeptOrGap(view, view.fitted));
    plot.series.push_back({FitLabel(view), Hue::vermilion, Line{time, fitted, 1.2, FitDash(view)}});
  }
  // the torque's axis is shared with the other close-ups
  plot.x = {TimeLabel(view), time[0], time.tail(1)[0]};
  plot.y = torque;
  return plot;
}

}  // namespace warmjoint::figures
