#include "identification/preparation/position_noise.h"

#include <algorithm>
#include <cmath>

#include "models/foundation/robust_noise.h"

namespace warmjoint::inline identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kNormalMedian = 0.6745;  // why: of |z|, z a standard normal variable

/// Standard deviation of the noise that third differences show.
double ThirdDifferenceNoise(const VectorXd& x) {
  const Index n = x.size() - 3;
  if (n < 1) return 0;
  VectorXd third = x.tail(n) - 3 * x.segment(2, n) + 3 * x.segment(1, n) - x.head(n);
  third = third.cwiseAbs();

  // 1^2 + 3^2 + 3^2 + 1^2 = 20
  return MedianInPlace(third) / (kNormalMedian * std::sqrt(20.0));
}

}  // namespace

PositionNoise MeasurePositionNoise(const VectorXd& position) {
  PositionNoise noise;
  const double floor = 1e-9 * (position.maxCoeff() - position.minCoeff());
  const double spread = ThirdDifferenceNoise(position);
  noise.resolution = Resolution(position);
  // rounding to steps leaves a deviation of step / sqrt(12); little more is taken for rounding alone
  const double rounding = noise.resolution / std::sqrt(12.0);
  const bool is_rounding = spread <= 1.7 * rounding;
  noise.deviation = std::max(is_rounding ? rounding : spread, floor);
  noise.reach = std::max(is_rounding ? 0.51 * noise.resolution : 4.5 * spread, floor);
  return noise;
}

RelativePosition FromFirst(const VectorXd& position) {
  const VectorXd moved = position.array() - position[0];
  const double smallest = Resolution(moved);
  if (smallest == 0) return {moved, 1};

  // the resolution from the longest way, where the rounding of numbers matters least
  const double way = moved.cwiseAbs().maxCoeff();
  const double step = way / std::round(way / smallest);
  return {(moved / step).array().round(), step};
}

}  // namespace warmjoint::inline identification
