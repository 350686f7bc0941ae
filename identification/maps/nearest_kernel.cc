#include "identification/maps/nearest_kernel.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "models/foundation/robust_noise.h"

namespace warmjoint {

namespace {

/// Index of the centre nearest to x, of ascending ones; of two as near, the lower one.
size_t NearestCentre(const GaussianAxis& axis, double x) {
  const std::vector<double>& centres = axis.centres;
  auto begin = centres.begin(), end = centres.end();
  // with directions apart, centres on the side of x
  if (axis.sides == Sides::apart && x != 0) {
    const auto positive = std::upper_bound(begin, end, 0.0);
    (x > 0 ? begin : end) = positive;
  }
  if (begin == end) return 0;
  // x within the period that begins at the first centre
  if (axis.period) x -= *axis.period * std::floor((x - *begin) / *axis.period);
  const auto above = std::lower_bound(begin, end, x);
  if (above == begin) return static_cast<size_t>(begin - centres.begin());
  const auto below = std::prev(above);
  // beyond the last centre of a circle the first may be nearer
  const bool around = above == end && axis.period && *begin + *axis.period - x < x - *below;
  const bool next = above != end && *above - x < x - *below;
  return static_cast<size_t>((around ? begin : next ? above : below) - centres.begin());
}

}  // namespace

Eigen::Index NearestKernel(const FrictionMap& map, const MapPoints& points, Eigen::Index sample) {
  size_t kernel = 0;
  for (const MapAxis& axis : map.axes) {
    const double x = points(sample, static_cast<Eigen::Index>(axis.quantity));
    kernel = kernel * axis.kernels.size() + NearestCentre(axis.kernels, x);
  }
  return static_cast<Eigen::Index>(kernel);
}

std::vector<std::optional<double>> SpeedsAtKernels(const FrictionMap& map, const MapPoints& kept) {
  // median speed of the samples nearest to each kernel
  std::vector<std::vector<double>> speeds(map.size());
  for (Eigen::Index i = 0; i < kept.rows(); ++i) {
    const auto nearest = static_cast<size_t>(NearestKernel(map, kept, i));
    speeds[nearest].push_back(std::abs(kept(i, static_cast<int>(MapQuantity::velocity))));
  }
  // the median of each kernel with samples
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

}  // namespace warmjoint
