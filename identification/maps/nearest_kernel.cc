#include "identification/maps/nearest_kernel.h"

#include <cmath>
#include <limits>

#include "models/foundation/robust_noise.h"

namespace warmjoint::inline identification {

Eigen::Index NearestKernel(const FrictionMap& map, const MapPoints& points, Eigen::Index sample) {
  size_t kernel = 0;
  for (const MapAxis& axis : map.axes) {
    const std::vector<double>& centres = axis.kernels.centres;
    const double x = points(sample, static_cast<Eigen::Index>(axis.quantity));
    size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (size_t c = 0; c < centres.size(); ++c) {
      double away = std::abs(x - centres[c]);
      if (axis.kernels.period) away = std::abs(std::remainder(away, *axis.kernels.period));
      const bool other_side = axis.kernels.sides == Sides::apart && x * centres[c] < 0;
      if (other_side || away >= least) continue;
      least = away;
      nearest = c;
    }
    kernel = kernel * centres.size() + nearest;
  }
  return static_cast<Eigen::Index>(kernel);
}

std::vector<std::optional<double>> SpeedsAtKernels(const FrictionMap& map, const MapPoints& kept) {
  std::vector<std::vector<double>> speeds(map.size());
  for (Eigen::Index i = 0; i < kept.rows(); ++i) {
    const auto nearest = static_cast<size_t>(NearestKernel(map, kept, i));
    speeds[nearest].push_back(std::abs(kept(i, static_cast<int>(MapQuantity::velocity))));
  }
  std::vector<std::optional<double>> medians(map.size());
  for (size_t k = 0; k < map.size(); ++k) {
    if (speeds[k].empty()) continue;
    const auto count = static_cast<Eigen::Index>(speeds[k].size());
    Eigen::VectorXd some = Eigen::Map<Eigen::VectorXd>(speeds[k].data(), count);
    medians[k] = MedianInPlace(some);
  }

  // those without samples take the next one's along the first axis
  const std::vector<std::optional<double>> own = medians;
  const size_t stride = map.size() / map.axes[0].kernels.centres.size();
  for (size_t k = 0; k < map.size(); ++k) {
    for (size_t away = stride; !medians[k] && away < map.size(); away += stride) {
      if (k >= away) medians[k] = own[k - away];
      if (!medians[k] && k + away < map.size()) medians[k] = own[k + away];
    }
  }
  return medians;
}

}  // namespace warmjoint::inline identification
