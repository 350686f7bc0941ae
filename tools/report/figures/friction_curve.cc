#include <algorithm>
#include <cmath>

#include "tools/report/figures/axes.h"
#include "tools/report/figures/fit_panels.h"
#include "tools/report/figures/friction_spread.h"

namespace warmjoint::report {
namespace {

constexpr int kPoints = 60;
constexpr std::size_t kPlaces = 300;
constexpr double kThinnestBand = 0.008;  // of the axis: about a line's width
constexpr double kNormal95 = 1.96;       // standard deviations of a 95 % interval

/// Places of kept samples of one direction, evenly over the recording, at one energy.
std::vector<JointPlace> PlacesOf(const FitView& view, int direction, double energy) {
  std::vector<Eigen::Index> samples;
  for (Eigen::Index i = 0; i < view.time.size(); ++i) {
    if (view.selection.keep[i] && view.velocity[i] * direction > 0) samples.push_back(i);
  }
  std::vector<JointPlace> places;
  const std::size_t step = std::max<std::size_t>(1, samples.size() / kPlaces);
  for (std::size_t i = 0; i < samples.size(); i += step) {
    places.push_back(PlaceAt(view, samples[i]));
    places.back().energy = energy;
  }
  return places;
}

/// The force of steady sliding, Eq. (20), at each speed: its mean over the places.
Eigen::VectorXd CurveOf(const FrictionDescription& friction, const Eigen::VectorXd& speeds,
                        const std::vector<JointPlace>& places) {
  const JointFriction joint(friction);
  return speeds.unaryExpr([&](double v) {
    double sum = 0;
    for (const JointPlace& place : places) sum += joint.SlidingForce(v, place);
    return sum / static_cast<double>(places.size());
  });
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
/// range: of the torque that is shown.
void AddCurves(Plot& plot, const FitView& view, const FrictionSpread& spread, double energy,
               double range, Hue hue, std::string label, std::vector<Eigen::VectorXd>& shown) {
  const FrictionDescription& friction = *view.estimate.friction;
  for (int direction : {1, -1}) {
    const Eigen::VectorXd speeds = SpeedsOf(KeptOf(view, view.velocity), direction);
    if (speeds.size() == 0) continue;
    // without maps every place is as good as another
    const std::vector<JointPlace> places = friction.maps.empty()
                                               ? std::vector<JointPlace>{{0, energy, 0}}
                                               : PlacesOf(view, direction, energy);
    if (places.empty()) continue;
    const Eigen::VectorXd force = CurveOf(friction, speeds, places);
    const Eigen::VectorXd deviation = SpreadOfPrediction(
        spread, friction,
        [&](const FrictionDescription& other) { return CurveOf(other, speeds, places); });
    if (deviation.size() > 0 && 2 * kNormal95 * deviation.maxCoeff() > kThinnestBand * range) {
      plot.series.push_back(
          {"", hue,
           Band{speeds, force - kNormal95 * deviation, force + kNormal95 * deviation, 0.35}});
    }
    plot.series.push_back({label, hue, Line{speeds, force, 2.0, FitDash(view)}});
    label.clear();
    shown.push_back(force);
  }
}

/// The kept samples; of a joint that warms, those before and after half of its warmth apart.
void AddMeasured(Plot& plot, const FitView& view, const Eigen::VectorXd& velocity,
                 const Eigen::VectorXd& torque) {
  constexpr double kDot = 1.1;  // points
  if (!view.warms()) {
    plot.series.push_back({"measured", Hue::grey, Scatter{velocity, torque, kDot}});
    return;
  }
  const Eigen::VectorXd energy = KeptOf(view, view.energy).cwiseAbs();
  const double half = std::abs(WarmestEnergy(view)) / 2;
  std::vector<Eigen::Index> cold, warm;
  for (Eigen::Index i = 0; i < energy.size(); ++i) (energy[i] < half ? cold : warm).push_back(i);
  plot.series.push_back(
      {"measured while cold", Hue::sky, Scatter{velocity(cold), torque(cold), kDot}});
  plot.series.push_back({"while warm", Hue::orange, Scatter{velocity(warm), torque(warm), kDot}});
}

}  // namespace

Plot FrictionCurve(const FitView& view) {
  const Eigen::VectorXd velocity = KeptOf(view, view.velocity);
  const Eigen::VectorXd torque = KeptOf(view, view.torque);
  Plot plot;
  AddMeasured(plot, view, velocity, torque);
  std::vector<Eigen::VectorXd> shown{torque};
  if (view.has_fit) {
    // parameters and maps stand in for each other: the spread of the law alone says nothing then
    const bool has_maps = !view.estimate.friction->maps.empty();
    const FrictionSpread spread =
        has_maps ? FrictionSpread{}
                 : SpreadOf(view.estimate, view.course, view.start, view.selection);
    const std::string what = FitLabel(view) + (has_maps ? ", mean over its maps" : "");
    const auto [lowest, highest] = RangeOf({torque});
    const double range = highest - lowest;
    AddCurves(plot, view, spread, 0, range, Hue::blue, view.warms() ? what + ", cold" : what,
              shown);
    if (view.warms()) {
      AddCurves(plot, view, spread, WarmestEnergy(view), range, Hue::vermilion, what + ", warmest",
                shown);
    }
  }
  plot.x = LinearAxis(SpeedLabel(view), {velocity});
  plot.y = LinearAxis(TorqueLabel(view, "torque"), shown);
  return plot;
}

}  // namespace warmjoint::report
