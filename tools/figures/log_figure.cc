// A recording as it was logged.
#include <fmt/core.h>

#include "tools/figures/axes.h"
#include "tools/figures/estimate_figures.h"

namespace warmjoint::figures {
namespace {

/// One column of the recording; the kept samples lie on top.
Plot ColumnPlot(const FitView& view, const Eigen::VectorXd& values, const std::string& label) {
  const Eigen::VectorXd time = view.time / TimeUnit(view);
  Plot plot;
  plot.series = {{"all samples", Hue::grey, Line{time, values, 1.0}},
                 {"kept for the fit", Hue::blue, Line{time, KeptOrGap(view, values), 1.4}}};
  plot.x = {TimeLabel(view), 0, time.tail(1)[0], Scale::linear, {}};
  plot.y = LinearAxis(label, {values});
  return plot;
}

}  // namespace

Figure MakeLogFigure(const FitView& view) {
  // how much of the log is kept, and from what motion
  const auto samples = view.time.size();
  const auto kept = view.selection.count();
  const double share = 100 * static_cast<double>(kept) / static_cast<double>(samples);
  const std::string segments = IsOfAnyMotion(view) ? "from motion of any kind"
                                                   : fmt::format("in {} segments of constant speed",
                                                                 view.selection.segments.size());
  // the same in words, below the title and for readers who cannot see it
  Figure figure = WithoutPanels(
      {"log", view.source,
       fmt::format("{} samples; {:.0f} % of them are kept, {}", samples, share, segments),
       fmt::format("Of {} samples {:.0f} % are kept for the fit, {}.", samples, share, segments)});
  // the torque as it was logged, with inertia and gravity
  const Eigen::VectorXd torque = view.torque + view.rigid;
  const Eigen::VectorXd* columns[] = {&view.position, &view.velocity, &torque};
  const std::string labels[] = {PositionLabel(view), SpeedLabel(view), TorqueLabel(view, "torque")};
  for (int i = 0; i < 3; ++i) {
    Plot plot = ColumnPlot(view, *columns[i], labels[i]);
    // one legend and one name of the time for all
    if (i > 0) plot.series[0].label = plot.series[1].label = "";
    if (i < 2) plot.x.label = "";
    AddPanel(figure, "", plot, 170);
  }
  return figure;
}

}  // namespace warmjoint::figures
