#include "identification/identifiers/left_over_place.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kBins[] = {8, 16, 32, 64, 128, 256};
constexpr double kDeviations = 2;  // of k F above its mean
constexpr double kTurn = 2 * std::numbers::pi;

/// From 0 to 1 over what was travelled. [n]
VectorXd ShareOfRange(const VectorXd& position) {
  const double lower = position.minCoeff(), range = position.maxCoeff() - lower;
  if (!(range > 0)) return VectorXd::Zero(position.size());
  return (position.array() - lower) / range;
}

/// From 0 to 1 over a turn. [n]
VectorXd ShareOfTurn(const VectorXd& angle) {
  return angle.unaryExpr([](double a) { return a / kTurn - std::floor(a / kTurn); });
}

/// Sum and number of the samples in each bin of either direction.
struct Means {
  VectorXd sums, counts;  // [2 bins]

  Means(const VectorXd& residual, const VectorXd& share, const VectorXd& velocity, Index bins)
      : sums(VectorXd::Zero(2 * bins)), counts(VectorXd::Zero(2 * bins)) {
    for (Index i = 0; i < residual.size(); ++i) {
      const auto place = static_cast<Index>(share[i] * static_cast<double>(bins));
      const Index bin = std::min(place, bins - 1) + (velocity[i] > 0 ? bins : 0);
      sums[bin] += residual[i];
      ++counts[bin];
    }
  }

  /// Squares that the means take.
  double Taken() const { return (sums.array().square() / counts.array().max(1)).sum(); }
  double Filled() const { return static_cast<double>((counts.array() > 0).count()); }
};

bool TakesMoreThanChance(const VectorXd& residual, const VectorXd& share, const VectorXd& velocity,
                         Index bins) {
  const Means means(residual, share, velocity, bins);
  const auto n = static_cast<double>(residual.size());
  // squares about one mean, and about the means of all bins that hold samples
  const double about_mean = residual.squaredNorm() - n * std::pow(residual.mean(), 2);
  const double about_bins = residual.squaredNorm() - means.Taken();
  const double freedom = means.Filled() - 1;
  if (freedom < 1 || !(about_bins > 0) || freedom > 0.5 * n) return false;

  // beyond what as many means take of noise alone
  const double taken = (about_mean - about_bins) / (about_bins / (n - freedom - 1));
  return taken > freedom + kDeviations * std::sqrt(2 * freedom);
}

}  // namespace

bool LeavesOverPlace(const VectorXd& residual, const MapPoints& points) {
  const auto column = [&](MapQuantity quantity) -> VectorXd {
    return points.col(static_cast<Index>(quantity));
  };
  const VectorXd velocity = column(MapQuantity::velocity);
  const VectorXd shares[] = {ShareOfRange(column(MapQuantity::position)),
                             ShareOfTurn(column(MapQuantity::motor_position))};
  for (const VectorXd& share : shares) {
    for (const Index bins : kBins) {
      if (TakesMoreThanChance(residual, share, velocity, bins)) return true;
    }
  }
  return false;
}

}  // namespace warmjoint
