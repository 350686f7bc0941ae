#include "identification/uncertainty/between_ends.h"

#include <cmath>
#include <numbers>

#include "identification/uncertainty/tails.h"

namespace warmjoint::inline identification {
namespace {

// why: the normal quantiles of 95 and 97.5 %, rounded outwards
constexpr double kLeast = 1.64, kMost = 1.96;
constexpr int kHalvings = 40;  // why: to the last digit

/// Phi(x).
double NormalProbability(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

}  // namespace

double ReachBeyondEnds(double range) {
  double low = kLeast, high = kMost;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    const double held = NormalProbability(middle + range) - NormalProbability(-middle);
    (held < kIntervalLevel ? low : high) = middle;
  }
  return high;
}

}  // namespace warmjoint::inline identification
