#include "identification/preparation/position_noise.h"

#include <algorithm>
#include <boost/sort/spreadsort/float_sort.hpp>
#include <cmath>
#include <cstdint>

#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kMisfit = 0.05;     // why: of ten steps of any size, 1e-10 are multiples by chance
constexpr double kLastBits = 1e-12;  // why: of the largest position, some bits of a double
constexpr Index kFew =
    64;  // steps; why: below each of them that is no multiple the divisor falls to a twentieth
constexpr double kNormalMedian = 0.6745;  // why: of |z|, z a standard normal variable

/// Standard deviation of the noise that third differences show, those that are 0 counted or not.
double ThirdDifferenceNoise(const VectorXd& x, bool with_zeros) {
  const Index n = x.size() - 3;
  if (n < 1) return 0;
  VectorXd third = x.tail(n) - 3 * x.segment(2, n) + 3 * x.segment(1, n) - x.head(n);
  third = third.cwiseAbs();
  if (!with_zeros && (third.array() > 0).any()) third = Chosen(third, third.array() > 0);

  // 1^2 + 3^2 + 3^2 + 1^2 = 20
  return MedianInPlace(third) / (kNormalMedian * std::sqrt(20.0));
}

/// The common divisor of ascending steps, each of which is a multiple to kMisfit, or 0. rounding: up to which a change is no step
double CommonDivisor(const double* begin, const double* end, double rounding) {
  double divisor = begin == end ? 0 : *begin;
  for (double left = divisor; left > 0;) {
    // the deviation of each step from a multiple of the divisor, which larger steps determine more finely
    left = 0;
    for (const double* step = begin; step < end; ++step) {
      // rounded by a conversion, which costs less than a call; a step is at most 2 / kLastBits divisors
      const auto multiple = static_cast<double>(static_cast<std::int64_t>(*step / divisor + 0.5));
      const double beyond = std::abs(*step - multiple * divisor);
      if (beyond <= kMisfit * divisor) {
        divisor = *step / multiple;
      } else if (left == 0 || beyond < left) {
        left = beyond;
      }
    }
    // the least deviation that is not rounding is a new divisor of all steps
    if (left > 0) divisor = left > rounding ? left : 0;
    if (divisor == 0) return 0;
  }
  return divisor;
}

}  // namespace

double StepOfPosition(const VectorXd& position) {
  const Index n = position.size() - 1;
  if (n < 1) return 0;
  VectorXd steps = (position.tail(n) - position.head(n)).cwiseAbs();
  const double range = steps.maxCoeff() - steps.minCoeff();
  // changes that are not the rounding of numbers, the smallest first
  const double rounding = kLastBits * position.cwiseAbs().maxCoeff();
  double* const end = steps.data() + n;
  double* const begin =
      std::partition(steps.data(), end, [&](double step) { return step <= rounding; });
  double* const few = begin + std::min<Index>(kFew, end - begin);

  // the smallest changes alone show that there is no divisor, so the others need not be sorted
  std::nth_element(begin, few, end);
  std::sort(begin, few);
  if (CommonDivisor(begin, few, rounding) == 0) return 0;
  boost::sort::spreadsort::float_sort(few, end);
  const double divisor = CommonDivisor(begin, end, rounding);
  return range > 0.5 * divisor ? divisor : 0;
}

PositionNoise MeasurePositionNoise(const VectorXd& position) {
  return MeasurePositionNoise(position, StepOfPosition(position));
}

PositionNoise MeasurePositionNoise(const VectorXd& position, double resolution) {
  PositionNoise noise;
  const double floor = 1e-9 * (position.maxCoeff() - position.minCoeff());
  noise.resolution = resolution;
  const double spread = ThirdDifferenceNoise(position, noise.resolution > 0);
  // rounding to steps leaves a deviation of step / sqrt(12); little more is taken for rounding alone
  const double rounding = noise.resolution / std::sqrt(12.0);
  const bool is_rounding = spread <= 1.7 * rounding;
  noise.deviation = std::max(is_rounding ? rounding : spread, floor);
  noise.reach = std::max(is_rounding ? 0.51 * noise.resolution : 4.5 * spread, floor);
  return noise;
}

RelativePosition FromFirst(const VectorXd& position) {
  const VectorXd moved = position.array() - position[0];
  const double smallest = StepOfPosition(moved);
  if (smallest == 0) return {moved, 1, 0};

  // the resolution from the longest travel, where the rounding of numbers matters least
  const double travel = moved.cwiseAbs().maxCoeff();
  const double step = travel / std::round(travel / smallest);
  return {(moved / step).array().round(), step, step};
}

}  // namespace warmjoint
