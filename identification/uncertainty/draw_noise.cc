#include "identification/uncertainty/draw_noise.h"

#include <algorithm>
#include <cmath>

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr double kDead = 1e-3;  // of the variance; why: far below what few draws can tell

/// Samples after which nothing is left of a start from 0.
Index Settling(const NoiseModel& noise, Index most) {
  if (noise.order() == 0) return 0;
  const Eigen::VectorXd covariances = CovariancesOf(noise, most);
  Index last = most;
  while (last > 0 && std::abs(covariances[last]) <= kDead * noise.variance) --last;
  return std::max(last, noise.order());
}

}  // namespace

Eigen::MatrixXd DrawNoise(const NoiseModel& noise, Index n, Index courses, StartStream& stream) {
  const Index p = noise.order();
  // half the width of a uniform distribution with the variance of the innovations
  const double half = std::sqrt(3 * (p == 0 ? noise.variance : noise.innovation));
  Eigen::VectorXd drawn(Settling(noise, n) + n);
  Eigen::MatrixXd all(n, courses);
  for (auto course : all.colwise()) {
    // the model's recursion, begun early enough to have settled
    for (Index i = 0; i < drawn.size(); ++i) {
      drawn[i] = stream.Uniform(-half, half);
      for (Index k = 0; k < std::min(p, i); ++k) {
        drawn[i] -= noise.coefficients[k] * drawn[i - 1 - k];
      }
    }
    course = drawn.tail(n);
  }
  return all;
}

}  // namespace warmjoint
