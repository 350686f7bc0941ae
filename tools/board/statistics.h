// Summaries of samples.
#pragma once

#include <vector>

namespace warmjoint::inline tools {

/// Median, quartiles and root mean square of a sample; NaN of an empty one.
struct Summary {
  double median;
  double q25;
  double q75;
  double rms;
};

/// The quantile of `sorted` (ascending) at `share` in [0, 1], linear between neighbours; NaN where
/// it is empty.
double Quantile(const std::vector<double>& sorted, double share);

/// Summary of the numbers in `values`; NaN among them are left out.
Summary Summarise(std::vector<double> values);

}  // namespace warmjoint::inline tools
