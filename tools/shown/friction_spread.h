// How sure a fitted friction is of what it predicts.
#pragma once

#include <warmjoint/estimate.h>

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

namespace warmjoint::shown {

/// Covariance of those of the estimate's values that its friction has, as wide as their intervals.
struct FrictionSpread {
  std::vector<std::string> names;  // [d] parameters of friction, as in the estimate
  Eigen::MatrixXd covariance;      // [d x d]; empty where the estimate has none

  bool is_known() const { return covariance.size() > 0; }
};

FrictionSpread SpreadOf(const Estimate& estimate);

/// The friction with one of its parameters changed by `step`.
Friction Changed(const Friction& friction, const std::string& name, double step);

/// Standard deviations of m predicted numbers: sqrt(diag(D C D^T)), D their derivatives by central
/// differences. predict: the m numbers of a friction.
template <typename Predict>
Eigen::VectorXd SpreadOfPrediction(const FrictionSpread& spread, const Friction& friction,
                                   const Predict& predict) {
  if (!spread.is_known()) return {};
  Eigen::MatrixXd derivatives;
  for (std::size_t i = 0; i < spread.names.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    // a hundredth of a standard deviation is small against every curvature
    const double step = 0.01 * std::sqrt(spread.covariance(at, at));
    const Eigen::VectorXd up = predict(Changed(friction, spread.names[i], step));
    const Eigen::VectorXd down = predict(Changed(friction, spread.names[i], -step));
    if (derivatives.size() == 0) derivatives.resize(up.size(), spread.covariance.rows());
    derivatives.col(at) = step > 0 ? Eigen::VectorXd((up - down) / (2 * step))
                                   : Eigen::VectorXd(Eigen::VectorXd::Zero(up.size()));
  }
  const Eigen::MatrixXd product = derivatives * spread.covariance;
  return product.cwiseProduct(derivatives).rowwise().sum().cwiseMax(0).cwiseSqrt();
}

}  // namespace warmjoint::shown
