#include "tools/shown/friction_doubt.h"

#include <warmjoint/friction_model.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/shown/friction_spread.h"

namespace warmjoint::shown {
namespace {

/// Root mean square of the deviations at speeds, N.m or N; 0 of none.
double StdOfColdFriction(const Estimate& estimate) {
  double sum = 0, count = 0;
  for (const FrictionAtSpeed& one : estimate.friction_at_speeds) {
    if (one.energy.value_or(0) != 0 || !std::isfinite(one.std)) continue;
    sum += one.std * one.std;
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

double MedianSpeed(const Estimate& estimate) {
  std::vector<double> speeds;
  for (const FrictionAtSpeed& one : estimate.friction_at_speeds) {
    speeds.push_back(std::abs(one.speed));
  }
  if (speeds.empty()) return 0;
  const auto middle = speeds.begin() + std::ssize(speeds) / 2;
  std::ranges::nth_element(speeds, middle);
  return *middle;
}

/// Deviation of the heat of sliding at a speed, N.m or N; 0 where it is not known.
double StdOfHeat(const Estimate& estimate, double speed) {
  const FrictionSpread spread = SpreadOf(estimate);
  const Friction& friction = *estimate.friction;
  if (!friction.thermal || !(speed > 0) || !spread.is_known()) return 0;
  // changes of a hundredth of a deviation that make a friction impossible tell nothing
  const double while_warming = friction.thermal->time_constant;
  bool is_possible = true;
  const auto heat = [&](const Friction& one) -> Eigen::VectorXd {
    if (!one.thermal || !(one.thermal->time_constant > 0)) {
      is_possible = false;
      return Eigen::VectorXd::Zero(2);
    }
    const auto settled = SettledEnergy(one, speed);
    if (!settled || settled->empty()) {
      is_possible = false;
      return Eigen::VectorXd::Zero(2);
    }
    double sum = 0;
    for (const double stage : *settled) sum += stage;
    return Eigen::Vector2d(sum, -sum * std::expm1(-while_warming / one.thermal->time_constant));
  };
  const double largest = SpreadOfPrediction(spread, friction, heat).maxCoeff();
  return is_possible && std::isfinite(largest) ? largest : 0;
}

}  // namespace

FrictionDoubt DoubtOf(const Estimate& estimate) {
  FrictionDoubt doubt;
  if (!estimate.friction) return doubt;
  doubt.level_std = StdOfColdFriction(estimate);
  doubt.heat_std = StdOfHeat(estimate, MedianSpeed(estimate));
  if (estimate.metrics && std::isfinite(estimate.metrics->rmse)) {
    doubt.noise = estimate.metrics->rmse;
  }
  return doubt;
}

}  // namespace warmjoint::shown
