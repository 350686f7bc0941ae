// Torque over velocity, with the fitted curve.
#include <algorithm>
#include <cmath>

#include "tools/figures/axes.h"
#include "tools/figures/fit_panels.h"
#include "tools/figures/friction_spread.h"
#include "tools/figures/speed_groups.h"

namespace warmjoint::figures {
namespace {

constexpr int kPoints = 60;
constexpr std::size_t kPlaces = 300;

/// The force of steady sliding at an energy and the mean speed of some samples: its mean over their places.
Eigen::Vector2d MeanOfMaps(const FitView& view, const std::vector<Eigen::Index>& samples,
                           double energy) {
  const JointFriction joint(*view.estimate.friction);
  const double speed = view.velocity(samples).mean();
  // a few hundred places are enough for a mean
  const std::size_t step = std::max<std::size_t>(1, samples.size() / kPlaces);
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < samples.size(); i += step, ++count) {
    // the place is one that the joint was at, the warmth is given
    JointPlace place = PlaceAt(view, samples[i]);
    place.energy = energy;
    sum += joint.SlidingForce(speed, place);
  }
  return {speed, sum / count};
}

/// A friction with maps has no curve over velocity: its mean at each speed, over the places where the joint
/// moved so.
void AddMeansOfMaps(Plot& plot, const FitView& view, double energy, Hue hue, std::string label,
                    std::vector<Eigen::VectorXd>& shown) {
  for (int direction : {1, -1}) {
    // one mean for each group of samples that are about as fast
    std::vector<double> speeds, forces;
    for (const SpeedGroup& group : GroupBySpeed(view, direction)) {
      if (group.samples.empty()) continue;
      const Eigen::Vector2d mean = MeanOfMaps(view, group.samples, energy);
      speeds.push_back(mean[0]);
      forces.push_back(mean[1]);
    }
    if (speeds.empty()) continue;
    // a line through the means; the legend names it once for both directions
    const Eigen::VectorXd x = VectorOf(speeds), y = VectorOf(forces);
    plot.series.push_back({label, hue, Line{x, y, 2.0, FitDash(view)}});
    plot.series.push_back({"", hue, Scatter{x, y, 3.0, Marker::diamond}});
    label.clear();
    shown.push_back(y);
  }
}

/// The force of steady sliding, Eq. (20), at each speed, of a friction without maps.
Eigen::VectorXd CurveOf(const Friction& friction, const Eigen::VectorXd& speeds, double energy) {
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
/// range: of the torque that is shown.
void AddCurves(Plot& plot, const FitView& view, const FrictionSpread& spread, double energy,
               double range, Hue hue, std::string label, std::vector<Eigen::VectorXd>& shown) {
  const Friction& friction = *view.estimate.friction;
  for (int direction : {1, -1}) {
    const Eigen::VectorXd speeds = SpeedsOf(KeptOf(view, view.velocity), direction);
    if (speeds.size() == 0) continue;
    // friction over velocity at this warmth, and how sure it is
    const Eigen::VectorXd force = CurveOf(friction, speeds, energy);
    const Eigen::VectorXd deviation = SpreadOfPrediction(
        spread, friction, [&](const Friction& other) { return CurveOf(other, speeds, energy); });
    AddBand(plot, "", hue, speeds, force, deviation, range);
    // the legend names the curve once for both directions
    plot.series.push_back({label, hue, Line{speeds, force, 2.0, FitDash(view)}});
    label.clear();
    shown.push_back(force);
  }
}

/// The kept samples; of a joint that warms, those before and after half of its warmth apart.
void AddMeasured(Plot& plot, const FitView& view, const Eigen::VectorXd& velocity,
                 const Eigen::VectorXd& torque) {
  constexpr double kDot = 1.1;  // points
  // without warming all samples are of one kind
  if (!view.warms()) {
    plot.series.push_back({"measured", Hue::grey, Scatter{velocity, torque, kDot}});
    return;
  }
  // colours part the samples at half of the largest warmth
  const Eigen::VectorXd energy = KeptOf(view, view.energy).cwiseAbs();
  const double half = std::abs(WarmestEnergy(view)) / 2;
  std::vector<Eigen::Index> cold, warm;
  for (Eigen::Index i = 0; i < energy.size(); ++i) (energy[i] < half ? cold : warm).push_back(i);
  plot.series.push_back(
      {"measured while cold", Hue::sky, Scatter{velocity(cold), torque(cold), kDot}});
  plot.series.push_back({"while warm", Hue::orange, Scatter{velocity(warm), torque(warm), kDot}});
}

/// The fit, cold and where it is warmest.
void AddFit(Plot& plot, const FitView& view, const Eigen::VectorXd& torque,
            std::vector<Eigen::VectorXd>& shown) {
  struct Level {
    double energy;
    Hue hue;
    const char* name;
  };
  // the cold curve, and the warmest where the joint warms
  std::vector<Level> levels{{0, Hue::blue, view.warms() ? ", cold" : ""}};
  if (view.warms()) levels.push_back({WarmestEnergy(view), Hue::vermilion, ", warmest"});
  // a friction with maps has no curve and so no band of it
  const bool has_maps = !view.estimate.friction->maps.empty();
  const auto [lowest, highest] = RangeOf({torque});
  const FrictionSpread spread = has_maps ? FrictionSpread{} : SpreadOf(view.estimate);
  // the fitted friction at each warmth
  for (const auto& [energy, hue, name] : levels) {
    if (has_maps) {
      AddMeansOfMaps(plot, view, energy, hue, FitLabel(view) + ", mean at each speed" + name,
                     shown);
    } else {
      AddCurves(plot, view, spread, energy, highest - lowest, hue, FitLabel(view) + name, shown);
    }
  }
}

}  // namespace

Plot FrictionCurve(const FitView& view) {
  const Eigen::VectorXd velocity = KeptOf(view, view.velocity);
  const Eigen::VectorXd torque = KeptOf(view, view.torque);
  Plot plot;
  AddMeasured(plot, view, velocity, torque);
  std::vector<Eigen::VectorXd> shown{torque};
  if (view.has_fit) AddFit(plot, view, torque, shown);
  plot.x = LinearAxis(SpeedLabel(view), {velocity});
  plot.y = LinearAxis(TorqueLabel(view, "torque"), shown);
  return plot;
}

}  // namespace warmjoint::figures
