#include "tools/figures/friction_spread.h"

#include <algorithm>

#include "identification/fit_parameters.h"

namespace warmjoint::figures {
namespace {

/// The number of a friction that a parameter of an estimate stands for; nothing where it is not of the friction.
double* NumberOf(Friction& friction, const std::string& name) {
  if (friction.thermal && name == NameOf(Role::heat, 0)) return &friction.thermal->gain;
  if (friction.thermal && name == NameOf(Role::heat, 1)) return &friction.thermal->time_constant;
  const auto found = friction.parameters.find(name);
  return found == friction.parameters.end() ? nullptr : &found->second;
}

}  // namespace

Friction Changed(const Friction& friction, const std::string& name, double step) {
  Friction changed = friction;
  *NumberOf(changed, name) += step;
  return changed;
}

FrictionSpread SpreadOf(const Estimate& estimate) {
  FrictionSpread spread;
  if (!estimate.friction || !estimate.covariance) return spread;
  const auto& [names, matrix] = *estimate.covariance;

  // rows of the friction's own parameters, each with a variance
  Friction friction = *estimate.friction;
  std::vector<Eigen::Index> places;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const std::string& name = names[static_cast<std::size_t>(i)];
    if (!NumberOf(friction, name) || !std::isfinite(matrix(i, i))) continue;
    places.push_back(i);
    spread.names.push_back(name);
  }
  spread.covariance = matrix(places, places);
  return spread;
}

}  // namespace warmjoint::figures
