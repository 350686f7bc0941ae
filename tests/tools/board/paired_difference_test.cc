#include "tools/board/paired_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(PairedDifference, OfEqualsIsATie) {
  const Difference difference = PairedDifference({1, 2, kInfinite}, {1, 2, kInfinite});
  EXPECT_EQ(difference.median, 0);
  EXPECT_TRUE(difference.tie());
}

TEST(PairedDifference, FindsASmallShiftUnderACommonScatter) {
  RandomStream random({1, 0}, Stream::test);
  std::vector<double> a, b;
  for (int i = 0; i < 100; ++i) {
    const double scatter = 10 * random.Normal();
    b.push_back(scatter);
    a.push_back(scatter + 0.5 + 0.1 * random.Normal());
  }
  const Difference difference = PairedDifference(a, b);
  EXPECT_FALSE(difference.tie());
  // the median of 100 draws of deviation 0.1 scatters by 0.0125; four of these
  EXPECT_NEAR(difference.median, 0.5, 0.05);
  EXPECT_LT(difference.lower, difference.median);
  EXPECT_GT(difference.upper, difference.median);
}

TEST(PairedDifference, FailuresAreInfinitelyFarBehind) {
  const Difference difference = PairedDifference({kInfinite, kInfinite, 1}, {1, 1, 1});
  EXPECT_EQ(difference.median, kInfinite);
  EXPECT_TRUE(std::isnan(PairedDifference({}, {}).median));
}

}  // namespace
}  // namespace warmjoint
