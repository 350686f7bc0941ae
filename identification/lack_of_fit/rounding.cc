#include "identification/lack_of_fit/rounding.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

constexpr double kEven = 1e-6;  // of a step: an error that does not matter
// of a step: noise that shows the torque within it; why: rounding.h
constexpr double kTells = 0.14;
constexpr int kFewestSteps = 3;  // why: whole multiples of one, to 5 %, by chance in 1 of 100
constexpr int kMostWaves = 50;   // then the next is below 1 % of a step

/// The standard deviation of the noise in steps: that of the residual without the part that the steps themselves make.
double NoiseInSteps(double variance, double step) {
  return std::sqrt(std::max(variance - step * step / 12, 0.0)) / step;
}

}  // namespace

double StepOf(const Eigen::VectorXd& torque) {
  if (const double step = Resolution(torque); step > 0) return step;
  Eigen::VectorXd sizes = torque.cwiseAbs();
  // where noise is hidden in a step, most neighbours repeat; in any other log the values need not be sorted
  const Eigen::Index others = sizes.size() - 1;
  if (2 * (sizes.tail(others).array() == sizes.head(others).array()).count() < others) return 0;
  std::ranges::sort(sizes);
  const Eigen::Index steps =
      (sizes.tail(sizes.size() - 1).array() > sizes.head(sizes.size() - 1).array()).count();
  return steps < kFewestSteps ? 0 : Resolution(sizes);
}

double HidingStep(const Eigen::VectorXd& torque, double variance) {
  const double step = StepOf(torque);
  return step > 0 && NoiseInSteps(variance, step) < kTells ? step : 0;
}

Eigen::VectorXd MeanRounding(const Eigen::VectorXd& torque, const Eigen::VectorXd& residual,
                             double variance) {
  using std::numbers::pi;
  const double step = Resolution(torque);
  if (step == 0) return {};
  const double noise = NoiseInSteps(variance, step);
  const auto size = [&](int k) { return std::exp(-2 * std::pow(pi * k * noise, 2)) / (pi * k); };
  if (size(1) < kEven) return {};

  // where each torque lies between two steps, counted from one that was logged
  const Eigen::ArrayXd place = (torque - residual).array() / step - torque[0] / step;

  // the series, each wave as much smaller as noise evens it out
  Eigen::ArrayXd error = Eigen::ArrayXd::Zero(torque.size());
  double sign = -1;
  for (int k = 1; k <= kMostWaves && size(k) >= kEven; ++k, sign = -sign) {
    error += sign * step * size(k) * (2 * pi * k * place).sin();
  }
  return error;
}

}  // namespace warmjoint
