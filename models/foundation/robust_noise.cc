#include "models/foundation/robust_noise.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace warmjoint {
namespace {
constexpr double kUnknown = std::numeric_limits<double>::infinity();
}  // namespace

double QuantileInPlace(Eigen::VectorXd& x, double quantile) {
  const auto rank = static_cast<Eigen::Index>(quantile * static_cast<double>(x.size()));
  double* value = x.data() + std::min(rank, x.size() - 1);
  std::nth_element(x.data(), value, x.data() + x.size());
  return *value;
}

double Quantile(const std::vector<double>& sorted, double share) {
  // between two neighbours in proportion; no difference of infinities is taken
  if (sorted.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double position = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const double beyond = position - static_cast<double>(below);
  const double lower = sorted[below];
  if (beyond == 0) return lower;
  const double upper = sorted[below + 1];
  return lower == upper ? lower : lower + beyond * (upper - lower);  // may be infinite
}

double MedianOf(Eigen::VectorXd values) { return values.size() > 0 ? MedianInPlace(values) : 0; }

double MedianOf(const std::vector<double>& values) {
  return MedianOf(Eigen::VectorXd(Eigen::VectorXd::Map(values.data(), std::ssize(values))));
}

double MedianStep(const Eigen::VectorXd& time) {
  const Eigen::Index n = time.size() - 1;
  Eigen::VectorXd steps = time.tail(n) - time.head(n);
  // an exact clock needs no search
  if (n > 0 && steps.minCoeff() == steps.maxCoeff()) return steps[0];
  return MedianInPlace(steps);
}

double WhiteNoise(const Eigen::VectorXd& x) {
  return WhiteNoise(x, SampleMask::Constant(x.size(), true));
}

double WhiteNoise(const Eigen::VectorXd& x, const SampleMask& use) {
  const Eigen::Index n = x.size() - 4;
  if (n < 1 || !use.segment(2, n).any()) return 0;
  // fourth differences, of which smooth motion leaves next to nothing
  Eigen::VectorXd differences =
      x.head(n) - 4 * x.segment(1, n) + 6 * x.segment(2, n) - 4 * x.segment(3, n) + x.tail(n);
  differences = Chosen(differences.cwiseAbs(), use.segment(2, n));

  // 1^2 + 4^2 + 6^2 + 4^2 + 1^2 = 70; the median of |z| of a standard normal is 0.6745
  return MedianInPlace(differences) / (0.6745 * std::sqrt(70.0));
}

Eigen::VectorXd Chosen(const Eigen::VectorXd& x, const SampleMask& use) {
  Eigen::VectorXd chosen(use.count());
  for (Eigen::Index i = 0, next = 0; i < x.size(); ++i) {
    if (use[i]) chosen[next++] = x[i];
  }
  return chosen;
}

double Resolution(const Eigen::VectorXd& x) {
  if (x.size() < 2) return 0;
  const Eigen::ArrayXd steps = (x.tail(x.size() - 1) - x.head(x.size() - 1)).cwiseAbs();
  // why 1e-9: differences over time stamps of hours at 1 kHz are exact to 2e-10 of the largest
  const double rounding = 1e-9 * x.cwiseAbs().maxCoeff();

  // the smallest step that is not rounding, and the largest, which is none either
  double smallest = kUnknown, largest = 0;
  for (const double step : steps) {
    if (step > rounding) smallest = std::min(smallest, step);
    largest = std::max(largest, step);
  }
  if (!(largest > rounding)) return 0;

  // every step a multiple of the smallest, and more than one kind of step
  double fewest = kUnknown, most = 0;
  for (const double step : steps) {
    const double multiple = step / smallest;
    if (!(std::abs(multiple - std::round(multiple)) <= 0.05)) return 0;
    fewest = std::min(fewest, multiple);
    most = std::max(most, multiple);
  }
  return fewest < most - 0.5 ? smallest : 0;
}

}  // namespace warmjoint
