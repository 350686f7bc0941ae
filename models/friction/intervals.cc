#include "models/friction/intervals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

constexpr double kSame = 1e-6;  // relative

/// Intervals without cold starts.
Intervals FindSteps(const Eigen::VectorXd& time) {
  const Eigen::Index n = time.size() - 1;
  const Eigen::ArrayXd steps = time.tail(n) - time.head(n);
  const double mean = (time[n] - time[0]) / static_cast<double>(n);
  // a clock that ticks evenly has one length
  if ((steps - mean).abs().maxCoeff() <= kSame * mean) {
    return EvenIntervals(n + 1, mean);
  }

  // ascending lengths, one for each group that the rounding of the time stamps makes
  Intervals intervals;
  std::vector<double> sorted(steps.begin(), steps.end());
  std::sort(sorted.begin(), sorted.end());
  intervals.typical = MedianStep(time);
  std::vector<int> count;
  for (const double step : sorted) {
    if (count.empty() || step > intervals.length.back() / count.back() * (1 + kSame)) {
      intervals.length.push_back(0);
      count.push_back(0);
    }
    intervals.length.back() += step;
    ++count.back();
  }
  for (size_t i = 0; i < count.size(); ++i) intervals.length[i] /= count[i];

  // nearest length of each step
  const auto index = [&](double step) {
    const auto above =
        std::upper_bound(intervals.length.begin(), intervals.length.end(), step * (1 + kSame));
    return static_cast<int>(std::max<std::ptrdiff_t>(0, above - intervals.length.begin() - 1));
  };
  intervals.which.reserve(time.size());
  for (const double step : steps) intervals.which.push_back(index(step));
  intervals.which.push_back(index(intervals.typical));
  return intervals;
}

}  // namespace

Intervals FindIntervals(const Eigen::VectorXd& time, const std::vector<Eigen::Index>& starts) {
  // the interval before a cold start is infinite, so that no heat is left
  Intervals intervals = FindSteps(time);
  if (starts.empty()) return intervals;
  const auto cold = static_cast<int>(intervals.length.size());
  intervals.length.push_back(std::numeric_limits<double>::infinity());
  for (const Eigen::Index start : starts) intervals.which[static_cast<size_t>(start) - 1] = cold;
  return intervals;
}

std::vector<IntervalHold> Holds(const Intervals& intervals, const Thermal& thermal) {
  std::vector<IntervalHold> holds;
  holds.reserve(intervals.length.size());
  for (const double h : intervals.length) {
    // nothing is left of the heat
    if (std::isinf(h)) {
      holds.push_back({0, 0, 0, 0});
      continue;
    }
    // the zero-order hold over the interval
    const ThermalHold<> hold = HoldOver(h, thermal.time_constant);
    holds.push_back({hold.pole, hold.cooling, thermal.gain * hold.cooling, hold.Slope()});
  }
  return holds;
}

}  // namespace warmjoint
