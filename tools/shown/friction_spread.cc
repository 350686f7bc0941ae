#include "tools/shown/friction_spread.h"

#include <cmath>
#include <iterator>

#include "identification/fit/fit_parameters.h"
#include "identification/uncertainty/tails.h"

namespace warmjoint::shown {
namespace {

/// The number of a friction that a parameter of an estimate stands for; nothing where it is not of the friction.
double* NumberOf(Friction& friction, const std::string& name) {
  if (friction.thermal && name == NameOf(Role::gain)) return &friction.thermal->gain;
  if (friction.thermal && name == NameOf(Role::time_constant))
    return &friction.thermal->time_constant;
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
  std::vector<double> scales;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const std::string& name = names[static_cast<std::size_t>(i)];
    if (!NumberOf(friction, name) || !std::isfinite(matrix(i, i))) continue;
    places.push_back(i);
    spread.names.push_back(name);
    // intervals reach as far as the covariance and what was found beside the noise
    const EstimatedParameter* known = estimate.Find(name);
    const bool tells = known && known->interval95 && matrix(i, i) > 0;
    scales.push_back(tells ? 0.5 * ((*known->interval95)[1] - (*known->interval95)[0]) /
                                 (kNormal95 * std::sqrt(matrix(i, i)))
                           : 1);
  }
  const Eigen::VectorXd scale =
      Eigen::Map<const Eigen::VectorXd>(scales.data(), std::ssize(scales));
  spread.covariance = scale.asDiagonal() * matrix(places, places).eval() * scale.asDiagonal();
  return spread;
}

}  // namespace warmjoint::shown
