#include "identification/uncertainty/tails.h"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace warmjoint::inline identification {
namespace {

// double throughout: tails are good to some 1e-13 of themselves, and the same with every compiler
using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// ln P(F >= f) where that is tiny: with x = n / (n + m f), a = n/2, b = m/2,
/// I_x(a, b) = x^a (1 - x)^b / (a B(a, b)) sum over k of x^k prod (a + b + j) / (a + 1 + j), j < k
/// (Abramowitz and Stegun 26.5.4), whose terms fall with x.
double LogTailOfF(double f, double m, double n) {
  const double log_x = -std::log1p(m / n * f);
  const double log_rest = std::log1p(-std::exp(log_x));
  const double log_beta = std::lgamma(n / 2) + std::lgamma(m / 2) - std::lgamma((m + n) / 2);

  // the series, until a term changes nothing
  const double x = std::exp(log_x), least = std::numeric_limits<double>::epsilon();
  double sum = 0, term = 1;
  for (double k = 0; term > least * sum; ++k) {
    sum += term;
    term *= x * ((m + n) / 2 + k) / (n / 2 + 1 + k);
  }
  return n / 2 * log_x + m / 2 * log_rest - std::log(n / 2) - log_beta + std::log(sum);
}

/// The z with ln PValueOfNormal(z) = log_p far out, where P = sqrt(2 / pi) exp(-z^2 / 2) / z up to
/// 1 / z^2 of itself: z^2 = -2 log_p - 2 ln z + ln(2 / pi), repeated until it stays.
double FarZ(double log_p) {
  double z = std::sqrt(-2 * log_p);
  for (int i = 0; i < 20; ++i) {
    z = std::sqrt(-2 * log_p - 2 * std::log(z) + std::log(2 / std::numbers::pi));
  }
  return z;
}

}  // namespace

double PValueOfNormal(double z) { return std::erfc(std::abs(z) / std::numbers::sqrt2); }

double ZOf(double p) {
  assert(p >= 0 && p <= 1);
  if (p == 0) return kInfinite;
  return std::numbers::sqrt2 * boost::math::erfc_inv(p, Policy());
}

double PValueOfStudent(double t, double freedom) {
  assert(freedom > 0);
  if (std::isinf(t)) return 0;
  const boost::math::students_t_distribution<double, Policy> student(freedom);
  return 2 * cdf(complement(student, std::abs(t)));
}

double StudentQuantile(double freedom, double level) {
  assert(level > 0 && level < 1);
  const boost::math::students_t_distribution<double, Policy> student(std::max(freedom, 1.0));
  return quantile(complement(student, (1 - level) / 2));
}

double PValueOfF(double f, double m, double n) {
  assert(f >= 0 && m > 0 && n > 0);
  if (std::isinf(f)) return 0;
  const boost::math::fisher_f_distribution<double, Policy> fisher(m, n);
  return cdf(complement(fisher, f));
}

double ZOfF(double f, double m, double n) {
  const double p = PValueOfF(f, m, n);
  // below the smallest normal double digits are lost
  if (p > std::numeric_limits<double>::min() || std::isinf(f)) return ZOf(p);
  return FarZ(LogTailOfF(f, m, n));
}

}  // namespace warmjoint::inline identification
