#include "tools/figures/friction_spread.h"

#include <cmath>

#include "identification/fit_parameters.h"
#include "identification/uncertainty/tails.h"
#include "tools/figures/axes.h"

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

void AddBand(Plot& plot, const std::string& label, Hue hue, const Eigen::VectorXd& x,
             const Eigen::VectorXd& y, const Eigen::VectorXd& deviation, double range) {
  constexpr double kThinnest = 0.008;  // of the range: about a line's width
  if (deviation.size() == 0) return;
  const Eigen::VectorXd reach = kNormal95 * deviation;
  if (2 * reach.maxCoeff() > kThinnest * range) {
    plot.series.push_back({label, hue, Band{x, y - reach, y + reach, 0.35}});
  }
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
  const Eigen::VectorXd scale = VectorOf(scales);
  spread.covariance = scale.asDiagonal() * matrix(places, places).eval() * scale.asDiagonal();
  return spread;
}

}  // namespace warmjoint::figures
