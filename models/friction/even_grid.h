// Whether the centres of an axis lie on an even grid.
#pragma once

#include <warmjoint/friction.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace warmjoint {

/// Spacing of the centres from `begin` to before `end`, which are two at least.
inline double SpacingOf(const GaussianAxis& axis, size_t begin, size_t end) {
  return (axis.centres[end - 1] - axis.centres[begin]) / static_cast<double>(end - 1 - begin);
}

/// Whether two or more centres are even to 1e-13 of their spacing and their own rounding, and close
/// evenly where they lie on a circle.
inline bool IsEvenGrid(const GaussianAxis& axis, size_t begin, size_t end) {
  if (end - begin < 2) return false;
  const double spacing = SpacingOf(axis, begin, end);
  const auto near = [&](double a, double b) {
    const double size = std::max(std::abs(a), std::abs(b));
    constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
    return std::abs(a - b) <= 1e-13 * spacing + rounding * size;
  };
  for (size_t i = begin; i < end; ++i) {
    const double even = axis.centres[begin] + static_cast<double>(i - begin) * spacing;
    if (!near(axis.centres[i], even)) return false;
  }
  return !axis.period || near(static_cast<double>(end - begin) * spacing, *axis.period);
}

}  // namespace warmjoint
