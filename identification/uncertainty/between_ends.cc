#include "identification/uncertainty/between_ends.h"

#include "identification/uncertainty/tails.h"

namespace warmjoint {
namespace {

// why: the normal quantiles of 95 and 97.5 %, rounded outwards
constexpr double kLeast = 1.64, kMost = 1.96;
constexpr int kHalvings = 40;  // why: to the last digit

}  // namespace

double ReachBeyondEnds(double range) {
  double low = kLeast, high = kMost;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    const double missed = 0.5 * (PValueOfNormal(middle + range) + PValueOfNormal(middle));
    (missed > 1 - kIntervalLevel ? low : high) = middle;
  }
  return high;
}

}  // namespace warmjoint
