#include <cmath>
#include <vector>

#include "tools/figures/axes.h"
#include "tools/figures/fit_panels.h"

namespace warmjoint::figures {
namespace {

/// The kept samples of each segment as strokes of their own. values: [N].
Line SegmentLine(const FitView& view, const Eigen::VectorXd& values) {
  std::vector<double> x, y;
  for (const Segment& segment : view.selection.segments) {
    // the kept samples of each segment
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
  const auto size = static_cast<Eigen::Index>(x.size());
  return {Eigen::Map<const Eigen::VectorXd>(x.data(), size),
          Eigen::Map<const Eigen::VectorXd>(y.data(), size), 1.5, FitDash(view)};
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
  const auto size = static_cast<Eigen::Index>(x.size());
  return {Eigen::Map<const Eigen::VectorXd>(x.data(), size),
          Eigen::Map<const Eigen::VectorXd>(lower.data(), size),
          Eigen::Map<const Eigen::VectorXd>(upper.data(), size)};
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
  const auto size = static_cast<Eigen::Index>(x.size());
  return {Eigen::Map<const Eigen::VectorXd>(x.data(), size),
          Eigen::Map<const Eigen::VectorXd>(y.data(), size), 2.0};
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
  plot.x = {TimeLabel(view), 0, view.time.tail(1)[0] / TimeUnit(view), Scale::linear, {}};
  plot.y = LinearAxis(TorqueLabel(view, "torque · sign(v)"), shown);
  return plot;
}

}  // namespace warmjoint::figures
