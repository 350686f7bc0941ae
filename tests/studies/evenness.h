// Whether numbers are spread evenly between 0 and 1.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace warmjoint {

/// p of Kolmogorov and Smirnov's test: the probability that n even numbers lie at least as far from evenness, by the
/// limiting distribution with Stephens' correction for n (Use of the Kolmogorov-Smirnov, Cramer-von Mises and related
/// statistics without extensive tables, 1970), right to 1 % from n = 20 on. 1 without numbers.
inline double ProbabilityOfEvenness(std::vector<double> numbers) {
  if (numbers.empty()) return 1;
  std::ranges::sort(numbers);
  const auto n = static_cast<double>(numbers.size());
  double distance = 0, below = 0;
  for (const double number : numbers) {
    distance = std::max({distance, number - below / n, (below + 1) / n - number});
    ++below;
  }

  const double root = std::sqrt(n), scaled = (root + 0.12 + 0.11 / root) * distance;
  constexpr double all = 0.3;  // below that p is 1 to 1e-5, and the series converges slowly
  if (scaled < all) return 1;
  double p = 0, sign = 1;
  for (int k = 1; k <= 100; ++k, sign = -sign) {
    p += 2 * sign * std::exp(-2 * k * k * scaled * scaled);
  }
  return std::clamp(p, 0.0, 1.0);
}

}  // namespace warmjoint
