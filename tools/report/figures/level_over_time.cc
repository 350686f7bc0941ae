#include <cmath>

#include "tools/report/figures/axes.h"
#include "tools/report/figures/fit_panels.h"

namespace warmjoint::report {

Plot LevelOverTime(const FitView& view) {
  const Eigen::VectorXd direction = view.velocity.array().sign();
  const Eigen::VectorXd time = KeptOf(view, view.time) / TimeUnit(view);
  const Eigen::VectorXd measured = KeptOf(view, view.torque.cwiseProduct(direction));

  Plot plot;
  plot.series.push_back({"measured", Hue::grey, Scatter{time, measured, 1.1}});
  std::vector<Eigen::VectorXd> shown{measured};
  if (view.has_fit) {
    const Eigen::VectorXd fitted = KeptOf(view, view.fitted.cwiseProduct(direction));
    plot.series.push_back({"fit", Hue::blue, Scatter{time, fitted, 0.9}});
    shown.push_back(fitted);
  }
  plot.x = {TimeLabel(view), 0, view.time.tail(1)[0] / TimeUnit(view), Scale::linear, {}};
  plot.y = LinearAxis(TorqueLabel(view, "torque · sign(v)"), shown);
  return plot;
}

}  // namespace warmjoint::report
