#include "identification/uncertainty/tails.h"

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace warmjoint {
namespace {

// double throughout: tails are good to some 1e-13 of themselves, and the same with every compiler
using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

// of ReachBeyondEnds; why: the normal quantiles of 95 and 97.5 %, rounded outwards
constexpr double kLeastReach = 1.64, kMostReach = 1.96;
constexpr int kHalvings = 40;  // why: to the last digit

}  // namespace

double PValueOfNormal(double z) { return std::erfc(std::abs(z) / std::numbers::sqrt2); }

double ZOf(double p) {
  assert(p >= 0 && p <= 1);
  if (p == 0) return std::numeric_limits<double>::infinity();
  return std::numbers::sqrt2 * boost::math::erfc_inv(p, Policy());
}

double PValueOfStudent(double t, double degrees_of_freedom) {
  if (std::isnan(t) || std::isnan(degrees_of_freedom)) return 1;
  assert(degrees_of_freedom > 0);
  if (std::isinf(t)) return 0;
  const boost::math::students_t_distribution<double, Policy> student(degrees_of_freedom);
  return 2 * cdf(complement(student, std::abs(t)));
}

double StudentQuantile(double degrees_of_freedom, double level) {
  assert(level > 0 && level < 1);
  const boost::math::students_t_distribution<double, Policy> student(
      degrees_of_freedom > 1 ? degrees_of_freedom : 1);
  return quantile(complement(student, (1 - level) / 2));
}

double PValueOfF(double f, double m, double n) {
  if (std::isnan(f)) return 1;
  assert(f >= 0 && m > 0 && n > 0);
  if (std::isinf(f)) return 0;
  const boost::math::fisher_f_distribution<double, Policy> fisher(m, n);
  return cdf(complement(fisher, f));
}

double ReachBeyondEnds(double range) {
  double low = kLeastReach, high = kMostReach;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    const double missed = 0.5 * (PValueOfNormal(middle + range) + PValueOfNormal(middle));
    (missed > 1 - kIntervalLevel ? low : high) = middle;
  }
  return high;
}

}  // namespace warmjoint
