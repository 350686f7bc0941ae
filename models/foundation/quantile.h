// Quantiles of samples.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace warmjoint {

/// The quantile of `sorted` (ascending) at `share` in [0, 1], linear between neighbours; NaN where
/// it is empty.
inline double Quantile(const std::vector<double>& sorted, double share) {
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

}  // namespace warmjoint
