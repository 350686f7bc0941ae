#include <cmath>
#include <vector>

#include "tools/report/figures/axes.h"
#include "tools/report/figures/fit_panels.h"

namespace warmjoint::report {
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

}  // namespace

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
    } else {
      plot.series.push_back({FitLabel(view), Hue::blue, SegmentLine(view, level)});
    }
    shown.push_back(fitted);
  }
  plot.x = {TimeLabel(view), 0, view.time.tail(1)[0] / TimeUnit(view), Scale::linear, {}};
  plot.y = LinearAxis(TorqueLabel(view, "torque · sign(v)"), shown);
  return plot;
}

}  // namespace warmjoint::report
