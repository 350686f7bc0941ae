#include "identification/uncertainty/student.h"

#include <cmath>
#include <numbers>

namespace warmjoint::inline identification {

double StudentQuantile(double freedom) {
  if (freedom <= 1) return std::tan(0.475 * std::numbers::pi);
  if (freedom <= 2) return 0.95 * std::sqrt(2 / (1 - 0.95 * 0.95));

  constexpr double z = 1.959963984540054;  // of the normal distribution
  const double z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z, z9 = z7 * z * z;
  const double n = freedom;
  return z + (z3 + z) / (4 * n) + (5 * z5 + 16 * z3 + 3 * z) / (96 * n * n) +
         (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * n * n * n) +
         (79 * z9 + 776 * z7 + 1482 * z5 - 1920 * z3 - 945 * z) / (92160 * n * n * n * n);
}

}  // namespace warmjoint::inline identification
