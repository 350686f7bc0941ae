#include "models/friction/intervals.h"

#include <gmock/gmock.h>

#include <cmath>

namespace warmjoint {
namespace {

TEST(Intervals, AreOneWhereOnlyRoundingMakesThemDiffer) {
  const Eigen::VectorXd time = 1e4 + 0.1 * Eigen::ArrayXd::LinSpaced(1000, 0, 999);
  const Intervals intervals = FindIntervals(time);
  ASSERT_EQ(intervals.length.size(), 1u);
  EXPECT_NEAR(intervals.length[0], 0.1, 1e-12);  // rounding of 1e4 s, averaged
}

TEST(Intervals, AreKeptApartWhereTheyDiffer) {
  const Eigen::VectorXd time = (Eigen::VectorXd(5) << 0, 1, 3, 4, 4.5).finished();
  const Intervals intervals = FindIntervals(time);
  EXPECT_THAT(intervals.length, ::testing::ElementsAre(0.5, 1, 2));
  EXPECT_THAT(intervals.which, ::testing::ElementsAre(1, 2, 1, 0, 1));
  EXPECT_EQ(intervals.typical, 1);
}

TEST(Holds, AreTheDiscretePairOfEachInterval) {
  Intervals intervals;
  intervals.length = {1, 15};
  const std::vector<IntervalHold> holds = Holds(intervals, {-3, 600});
  EXPECT_EQ(holds[1].pole, std::exp(-15.0 / 600));
  EXPECT_NEAR(holds[1].gain, -3 * (1 - std::exp(-15.0 / 600)), 1e-14);
  // te of a slightly larger tau: a difference quotient with a step of 1e-6
  const double more = std::exp(-15.0 / (600 * std::exp(1e-6)));
  EXPECT_NEAR(holds[1].pole_slope, (more - holds[1].pole) / 1e-6, 1e-6 * holds[1].pole_slope);
}

}  // namespace
}  // namespace warmjoint
