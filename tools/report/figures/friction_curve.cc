#include <algorithm>
#include <cmath>

#include "tools/report/figures/axes.h"
#include "tools/report/figures/fit_panels.h"
#include "tools/report/figures/friction_spread.h"

namespace warmjoint::report {
namespace {

constexpr int kPoints = 60;
constexpr double kNormal95 = 1.96;  // standard deviations of a 95 % interval

/// The force of steady sliding without maps and load, Eq. (20), at each speed.
Eigen::VectorXd CurveOf(FrictionDescription friction, const Eigen::VectorXd& speeds,
                        double energy) {
  friction.maps.clear();
  const JointFriction joint(friction);
  return speeds.unaryExpr([&](double v) { return joint.SlidingForce(v, {0, energy, 0}); });
}

/// Speeds of one direction from the slowest to the fastest kept one; empty where it never moved so.
Eigen::VectorXd SpeedsOf(const Eigen::VectorXd& kept, int direction) {
  const Eigen::ArrayXd speeds = kept.array() * direction;
  const double fastest = speeds.size() ? speeds.maxCoeff() : 0;
  if (fastest <= 0) return {};
  double slowest = fastest;
  for (double speed : speeds) {
    if (speed > 0) slowest = std::min(slowest, speed);
  }
  return direction * Eigen::VectorXd::LinSpaced(kPoints, slowest, fastest);
}

/// One curve for each direction, remembered in `shown`; the label stands in the legend once.
void AddCurves(Plot& plot, const FitView& view, const FrictionSpread& spread, double energy,
               Hue hue, std::string label, std::vector<Eigen::VectorXd>& shown) {
  const FrictionDescription& friction = *view.estimate.friction;
  for (int direction : {1, -1}) {
    const Eigen::VectorXd speeds = SpeedsOf(KeptOf(view, view.velocity), direction);
    if (speeds.size() == 0) continue;
    const Eigen::VectorXd force = CurveOf(friction, speeds, energy);
    const Eigen::VectorXd deviation = SpreadOfPrediction(
        spread, friction,
        [&](const FrictionDescription& other) { return CurveOf(other, speeds, energy); });
    if (deviation.size() > 0) {
      plot.series.push_back(
          {"", hue,
           Band{speeds, force - kNormal95 * deviation, force + kNormal95 * deviation, 0.35}});
    }
    plot.series.push_back({label, hue, Line{speeds, force, 2.0}});
    label.clear();
    shown.push_back(force);
  }
}

}  // namespace

Plot FrictionCurve(const FitView& view) {
  const Eigen::VectorXd velocity = KeptOf(view, view.velocity);
  const Eigen::VectorXd torque = KeptOf(view, view.torque);
  Plot plot;
  plot.series.push_back({"measured", Hue::grey, Scatter{velocity, torque, 1.1}});
  std::vector<Eigen::VectorXd> shown{torque};
  if (view.has_fit) {
    // parameters and maps stand in for each other: the spread of the law alone says nothing then
    const bool has_maps = !view.estimate.friction->maps.empty();
    const FrictionSpread spread =
        has_maps ? FrictionSpread{}
                 : SpreadOf(view.estimate, view.course, view.start, view.selection);
    const std::string what = has_maps ? "law without its maps" : "fit";
    AddCurves(plot, view, spread, 0, Hue::blue, view.warms() ? what + ", cold" : what, shown);
    if (view.warms()) {
      AddCurves(plot, view, spread, WarmestEnergy(view), Hue::vermilion, what + ", warmest", shown);
    }
  }
  plot.x = LinearAxis(SpeedLabel(view), {velocity});
  plot.y = LinearAxis(TorqueLabel(view, "torque"), shown);
  return plot;
}

}  // namespace warmjoint::report
