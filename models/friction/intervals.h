// The times between samples, even or not, and the thermal pole over each of them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/friction/thermal.h"

namespace warmjoint {

/// Intervals of a recording. Lengths that differ by less than a millionth count as one.
struct Intervals {
  std::vector<double> length;  // [m] distinct intervals, s, ascending; infinite before a cold start
  std::vector<int> which;      // [N] index into `length` of the interval that follows each sample
  double typical = 0;          // median, s

  bool even() const { return length.size() == 1; }
};

/// time: [N] s, strictly increasing, N >= 2. The last sample's interval is the typical one.
/// starts: samples, above 0, at which the joint is cold again.
Intervals FindIntervals(const Eigen::VectorXd& time, const std::vector<Eigen::Index>& starts = {});

/// N samples that are all h apart, s.
inline Intervals EvenIntervals(Eigen::Index n, double h) {
  return {{h}, std::vector<int>(static_cast<size_t>(n), 0), h};
}

/// ThermalHold over one interval, as inner loops want it: E <- pole E + gain W.
struct IntervalHold {
  double pole = 0;        // te = exp(-h/tau)
  double cooling = 0;     // 1 - te
  double gain = 0;        // ke = k (1 - te)
  double pole_slope = 0;  // dte/dlog(tau)
};

/// One for each distinct interval. After an infinite one nothing is left of energy or loss.
std::vector<IntervalHold> Holds(const Intervals& intervals, const Thermal& thermal);

}  // namespace warmjoint
