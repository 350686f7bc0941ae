#include "sim/dataset/robust_noise.h"

#include <algorithm>
#include <cmath>

namespace warmjoint {

double MedianInPlace(Eigen::VectorXd& x) {
  double* middle = x.data() + x.size() / 2;
  std::nth_element(x.data(), middle, x.data() + x.size());
  return *middle;
}

double WhiteNoise(const Eigen::VectorXd& x) {
  const Eigen::Index n = x.size() - 4;
  if (n < 1) return 0;
  Eigen::VectorXd differences =
      x.head(n) - 4 * x.segment(1, n) + 6 * x.segment(2, n) - 4 * x.segment(3, n) + x.tail(n);
  differences = differences.cwiseAbs();

  // 1^2 + 4^2 + 6^2 + 4^2 + 1^2 = 70; the median of |z| of a standard normal is 0.6745
  return MedianInPlace(differences) / (0.6745 * std::sqrt(70.0));
}

double Resolution(const Eigen::VectorXd& x) {
  double smallest = 0;
  for (Eigen::Index i = 1; i < x.size(); ++i) {
    const double step = std::abs(x[i] - x[i - 1]);
    if (step > 0 && (smallest == 0 || step < smallest)) smallest = step;
  }
  return smallest;
}

}  // namespace warmjoint
