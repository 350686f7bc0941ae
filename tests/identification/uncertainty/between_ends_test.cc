#include "identification/uncertainty/between_ends.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

TEST(ReachBeyondEnds, IsTheTwoSidedQuantileOfOneAndTheOneSidedOfTwoFarApart) {
  EXPECT_NEAR(ReachBeyondEnds(0), 1.959964, 1e-4);
  EXPECT_NEAR(ReachBeyondEnds(10), 1.644854, 1e-5);
  EXPECT_LT(ReachBeyondEnds(1), ReachBeyondEnds(0.5));
}

TEST(ReachBeyondEnds, HoldsEitherEndAsOftenAsItSays) {
  constexpr int kDraws = 100'000;
  RandomStream random({6, 3}, Stream::test);
  for (const double range : {0.2, 1.0, 4.0}) {
    const double reach = ReachBeyondEnds(range);
    int held = 0;
    for (int i = 0; i < kDraws; ++i) {
      // the truth is one end, 0; the other lies above the estimate of it
      const double estimate = random.Normal();
      held += estimate - reach <= 0 && 0 <= estimate + range + reach;
    }
    // 4 standard errors
    const double share = static_cast<double>(held) / kDraws;
    EXPECT_NEAR(share, 0.95, 4 * std::sqrt(0.95 * 0.05 / kDraws)) << range;
  }
}

}  // namespace
}  // namespace warmjoint
