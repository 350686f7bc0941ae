#include "tools/board/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace warmjoint::inline tools {

double Quantile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double position = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<size_t>(position);
  const double beyond = position - static_cast<double>(below);
  if (beyond == 0 || sorted[below] == sorted[below + 1]) return sorted[below];  // may be infinite
  return sorted[below] + beyond * (sorted[below + 1] - sorted[below]);
}

Summary Summarise(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  std::sort(values.begin(), values.end());
  double squares = 0;
  for (const double value : values) squares += value * value;
  return {Quantile(values, 0.5), Quantile(values, 0.25), Quantile(values, 0.75),
          std::sqrt(squares / static_cast<double>(values.size()))};
}

}  // namespace warmjoint::inline tools
