// Derivatives of every law's force for its parameters, by the dual numbers that Ceres uses.
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "models/friction/laws.h"

namespace warmjoint {
namespace {

template <typename L>
void CompareWithDifferences() {
  SCOPED_TRACE(L::name);
  constexpr int d = L::parameters.size();
  using Jet = ceres::Jet<double, d>;
  for (const double v : {-1.3, -0.02, 0.0, 1e-6, 0.15, 0.8}) {
    double p[d];
    Jet x[d];
    for (int i = 0; i < d; ++i) x[i] = Jet(p[i] = 0.4 + 0.3 * i, i);
    const Jet force = L::Force(v, x);
    EXPECT_DOUBLE_EQ(force.a, L::Force(v, p));

    for (int i = 0; i < d; ++i) {
      const double step = 1e-6, here = p[i];
      p[i] = here + step;
      const double above = L::Force(v, p);
      p[i] = here - step;
      const double slope = (above - L::Force(v, p)) / (2 * step);
      p[i] = here;
      // third derivatives of size 100 times step^2 / 6, and rounding 1e-16 / step of a force of 2
      EXPECT_NEAR(force.v[i], slope, 1e-9) << "parameter " << i << " at " << v;
    }
  }
}

template <typename... L>
void CompareAll(LawList<L...>) {
  (CompareWithDifferences<L>(), ...);
}

TEST(LawDerivatives, AreThoseOfFiniteDifferences) { CompareAll(AllLaws{}); }

}  // namespace
}  // namespace warmjoint
