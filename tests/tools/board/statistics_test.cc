#include "tools/board/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace warmjoint {
namespace {

TEST(Statistics, SummariseKnownSamples) {
  const Summary summary = Summarise({4, 1, 3, 2});
  EXPECT_EQ(summary.median, 2.5);
  EXPECT_EQ(summary.q25, 1.75);
  EXPECT_EQ(summary.q75, 3.25);
  EXPECT_DOUBLE_EQ(summary.rms, std::sqrt(30.0 / 4));
}

TEST(Statistics, LeaveOutWhatIsNoNumber) {
  const Summary summary = Summarise({NAN, 2, NAN});
  EXPECT_EQ(summary.median, 2);
  EXPECT_EQ(summary.rms, 2);
  EXPECT_TRUE(std::isnan(Summarise({NAN}).median));
  EXPECT_TRUE(std::isnan(Summarise({}).rms));
}

TEST(Statistics, QuantilesStandInfinities) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(Quantile({1, infinity, infinity}, 0.5), infinity);
  EXPECT_EQ(Quantile({1, 2, infinity}, 0.5), 2);
}

}  // namespace
}  // namespace warmjoint
