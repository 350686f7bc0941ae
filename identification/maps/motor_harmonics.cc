#include "identification/maps/motor_harmonics.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "identification/ridge/local_rows.h"

namespace warmjoint {
namespace {

constexpr int kAngles = 256;
constexpr double kChance = 23;

/// Angles times speeds at which the map is averaged, of one direction of motion.
MapPoints Grid(const FrictionMap& map, int direction) {
  // speeds of the map in this direction; one where it has none
  std::vector<double> speeds;
  for (const MapAxis& axis : map.axes) {
    if (axis.quantity != MapQuantity::velocity) continue;
    for (const double centre : axis.kernels.centres) {
      if ((centre > 0) == (direction == 1)) speeds.push_back(centre);
    }
  }
  if (speeds.empty()) speeds.push_back(direction == 1 ? 1 : -1);
  const auto count = static_cast<Eigen::Index>(speeds.size());
  // a whole turn at each of them
  MapPoints points = MapPoints::Zero(kAngles * count, 5);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const double turn = static_cast<double>(i / count) / kAngles;
    points(i, static_cast<int>(MapQuantity::motor_position)) = 2 * std::numbers::pi * turn;
    points(i, static_cast<int>(MapQuantity::velocity)) = speeds[i % count];
  }
  return points;
}

}  // namespace

std::vector<MotorHarmonic> MotorHarmonics(const FrictionMap& map, const Eigen::MatrixXd& covariance,
                                          int direction) {
  // kernels on the grid, over which sums are Fourier coefficients
  const MapPoints points = Grid(map, direction);
  const Eigen::MatrixXd kernels = DenseKernels({map}, points, 0, points.rows());
  const Eigen::Map<const Eigen::VectorXd> weights(map.weights.data(), kernels.cols());
  const Eigen::ArrayXd angle = points.col(static_cast<int>(MapQuantity::motor_position));
  const double scale = 2 / static_cast<double>(points.rows());

  std::vector<MotorHarmonic> harmonics;
  const auto highest = static_cast<int>(map.axes.front().kernels.size() / 2);
  for (int k = 1; k <= highest; ++k) {
    // both parts as linear functions of the weights
    Eigen::MatrixXd parts(2, kernels.cols());
    parts.row(0) = scale * (k * angle).cos().matrix().transpose() * kernels;
    parts.row(1) = scale * (k * angle).sin().matrix().transpose() * kernels;
    const Eigen::Vector2d z = parts * weights;
    const Eigen::Matrix2d spread = parts * covariance * parts.transpose();
    harmonics.push_back({k, z.norm(), z.dot(spread.inverse() * z)});
  }
  return harmonics;
}

std::vector<MotorHarmonic> DominantHarmonics(std::vector<MotorHarmonic> harmonics) {
  std::erase_if(harmonics, [](const MotorHarmonic& h) { return !(h.significance > kChance); });
  std::stable_sort(harmonics.begin(), harmonics.end(),
                   [](const auto& a, const auto& b) { return a.amplitude > b.amplitude; });
  std::erase_if(harmonics, [largest = harmonics.empty() ? 0 : harmonics.front().amplitude](
                               const MotorHarmonic& h) { return h.amplitude < 0.2 * largest; });
  return harmonics;
}

}  // namespace warmjoint
