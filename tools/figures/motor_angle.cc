// What a joint's torque owes to the angle of its motor.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "tools/figures/axes.h"
#include "tools/figures/estimate_figures.h"
#include "tools/figures/number_text.h"
#include "tools/figures/speed_groups.h"

namespace warmjoint::figures {
namespace {

constexpr Eigen::Index kMostBins = 72, kFewestBins = 8;
constexpr double kFaint = 0.3;  // opacity of samples behind lines of the same colour
constexpr Eigen::Index kSamplesPerBin = 12;

/// Peak to peak of a line, over its finite points.
double Swing(const Line& line) {
  const auto [lowest, highest] = RangeOf({line.y});
  return highest - lowest;
}

struct DirectionPanel {
  Plot plot;
  double largest_swing = 0;  // torque unit
  Eigen::Index beyond = 0;   // samples that the axis leaves out
};

DirectionPanel PanelOf(const FitView& view, int direction, const std::string& label) {
  DirectionPanel panel;
  std::vector<Eigen::VectorXd> shown;
  std::vector<Series> medians;
  for (const SpeedGroup& group : GroupBySpeed(view, direction)) {
    if (group.samples.empty()) continue;
    // without the warming only the angle is left to explain the torque
    Eigen::VectorXd torque = view.torque(group.samples);
    if (view.warms()) torque -= direction * view.energy(group.samples);
    const Eigen::VectorXd angle = view.motor_angle(group.samples);
    // as many bins as the samples bear
    const Eigen::Index bins = std::clamp(angle.size() / kSamplesPerBin, kFewestBins, kMostBins);
    const Line median = BinnedMedian(angle, torque, static_cast<int>(bins));
    panel.plot.series.push_back(
        {"", group.hue, Scatter{angle, torque, 0.8, Marker::circle, kFaint}});
    medians.push_back({group.label, group.hue, median});
    shown.push_back(torque);
    panel.largest_swing = std::max(panel.largest_swing, Swing(median));
  }
  // medians over all dots
  panel.plot.series.insert(panel.plot.series.end(), medians.begin(), medians.end());
  panel.plot.x = AngleAxis("motor angle (rad)");
  panel.plot.y = BulkAxis(label, shown);
  // torques that the axis leaves out are counted
  panel.beyond = CountBeyond(panel.plot.y, shown);
  return panel;
}

}  // namespace

std::optional<Figure> MakeMotorAngle(const FitView& view) {
  if (view.motor_angle.size() == 0 || view.selection.segments.empty()) return std::nullopt;
  const std::string label = TorqueLabel(view, view.warms() ? "torque − sign(v) E" : "torque");
  const DirectionPanel forwards = PanelOf(view, 1, label), backwards = PanelOf(view, -1, label);

  // how much the angle of the motor matters at one speed
  const std::string finding =
      fmt::format("Over one turn of the motor the median torque at a speed varies by up to {} {}.",
                  SignificantText(std::max(forwards.largest_swing, backwards.largest_swing), 2),
                  view.torque_unit);
  // a direction that the joint never took has no panel
  Figure figure =
      RowOfPlots({"motor_angle", "Torque over motor angle",
                  fmt::format("{}: samples at constant speed, with their medians", view.source) +
                      BeyondText(forwards.beyond + backwards.beyond),
                  finding},
                 430, {{"Forwards", forwards.plot}, {"Backwards", backwards.plot}});
  if (figure.panels.empty()) return std::nullopt;
  return figure;
}

}  // namespace warmjoint::figures
