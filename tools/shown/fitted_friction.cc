#include "tools/shown/fitted_friction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "models/friction/evaluate_map.h"
#include "tools/shown/friction_spread.h"

namespace warmjoint::shown {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kPoints = 60;                   // of a curve
constexpr Index kColumns = 180, kRows = 120;  // of a map
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Cold, half as warm as the recording gets, and at its warmest.
std::vector<double> HeatsOf(const FitView& view) {
  if (!view.warms()) return {0};
  const double warmest = WarmestEnergy(view);
  return {0, warmest / 2, warmest};
}

/// Speeds of one direction from the slowest to the fastest kept one; empty where it never moved so.
VectorXd SpeedsOf(const VectorXd& kept, int direction) {
  double slowest = INFINITY, fastest = 0;
  for (const double velocity : kept) {
    if (velocity * direction <= 0) continue;
    slowest = std::min(slowest, velocity * direction);
    fastest = std::max(fastest, velocity * direction);
  }
  if (fastest == 0) return {};
  return direction * VectorXd::LinSpaced(kPoints, slowest, fastest);
}

/// Eq. (20) at each speed, of a friction without maps. load: that the joint carries, N.m or N
VectorXd ForceOver(const Friction& friction, const VectorXd& speeds, double energy, double load) {
  const JointFriction joint(friction);
  return speeds.unaryExpr([&](double v) { return joint.SlidingForce(v, {0, energy, load}); });
}

/// At the kept samples, each at its place with the heat that `energy_at` says.
template <typename EnergyAt>
VectorXd ForceAlong(const FitView& view, const Friction& friction, const EnergyAt& energy_at) {
  const JointFriction joint(friction);
  VectorXd force = VectorXd::Constant(view.time.size(), kUnknown);
  for (Index i = 0; i < force.size(); ++i) {
    if (!view.selection.keep[i]) continue;
    JointPlace place = PlaceAt(view, i);
    place.energy = energy_at(i);
    force[i] = joint.SlidingForce(view.velocity[i], place);
  }
  return force;
}

bool IsOver(const FrictionMap& map, MapQuantity quantity) {
  return FindAxis(map, quantity) != nullptr;
}

}  // namespace

std::vector<FrictionCurve> CurvesOf(const FitView& view) {
  std::vector<FrictionCurve> curves;
  if (!view.has_fit || view.has_maps()) return curves;
  const Friction& friction = *view.estimate.friction;
  const FrictionSpread spread = SpreadOf(view.estimate);
  const VectorXd kept = KeptOf(view, view.velocity);
  const double load = MeanLoad(view);
  for (const double energy : HeatsOf(view)) {
    for (const int direction : {1, -1}) {
      const VectorXd speeds = SpeedsOf(kept, direction);
      if (speeds.size() == 0) continue;
      const auto predict = [&](const Friction& other) {
        return ForceOver(other, speeds, energy, load);
      };
      curves.push_back(
          {energy, speeds, predict(friction), SpreadOfPrediction(spread, friction, predict)});
    }
  }
  return curves;
}

std::vector<ForceAtHeat> ForcesOf(const FitView& view) {
  std::vector<ForceAtHeat> forces;
  if (!view.has_maps()) return forces;
  for (const double energy : HeatsOf(view)) {
    forces.push_back(
        {energy, ForceAlong(view, *view.estimate.friction, [&](Index) { return energy; })});
  }
  return forces;
}

MotorMaps MotorMapsOf(const FitView& view) {
  const auto heat = [&](Index i) { return view.energy[i]; };
  Friction without = *view.estimate.friction;
  std::erase_if(without.maps,
                [](const FrictionMap& map) { return IsOver(map, MapQuantity::motor_position); });
  return {ForceAlong(view, *view.estimate.friction, heat), ForceAlong(view, without, heat)};
}

std::optional<AngleMap> AngleMapOf(const FitView& view) {
  if (!view.has_maps() || view.selection.count() == 0) return std::nullopt;
  const auto& maps = view.estimate.friction->maps;
  const auto any = [&](MapQuantity quantity) {
    return std::ranges::any_of(maps, [&](const FrictionMap& map) { return IsOver(map, quantity); });
  };
  // a map over the motor's angle goes first, otherwise one over the joint's position
  AngleMap map;
  map.over_motor = any(MapQuantity::motor_position);
  if (!map.over_motor && !any(MapQuantity::position)) return std::nullopt;
  map.lower = map.over_motor ? 0 : view.position.minCoeff();
  map.upper = map.over_motor ? 2 * std::numbers::pi : view.position.maxCoeff();
  map.fastest = KeptOf(view, view.velocity).cwiseAbs().maxCoeff();
  map.energies =
      view.warms() ? std::vector<double>{0, WarmestEnergy(view)} : std::vector<double>{0};
  const double middle = KeptOf(view, view.position).mean();
  const JointFriction sliding(*view.estimate.friction);

  // the level of steady friction at the middle of each cell
  for (const double energy : map.energies) {
    Eigen::MatrixXd level(kRows, kColumns);
    for (Index row = 0; row < kRows; ++row) {
      const double v = map.fastest * (2 * (static_cast<double>(row) + 0.5) / kRows - 1);
      for (Index column = 0; column < kColumns; ++column) {
        const double share = (static_cast<double>(column) + 0.5) / kColumns;
        const double angle = map.lower + share * (map.upper - map.lower);
        const JointPlace place{map.over_motor ? middle : angle, energy, 0,
                               map.over_motor ? angle : 0};
        level(row, column) = Sign(v) * sliding.SlidingForce(v, place);
      }
    }
    map.levels.push_back(level);
  }
  return map;
}

}  // namespace warmjoint::shown
