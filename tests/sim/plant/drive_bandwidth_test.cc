#include "sim/plant/velocity_drive.h"

#include <gtest/gtest.h>

#include <cmath>

namespace warmjoint {
namespace {

TEST(SufficientBandwidth, EndsStickingWithinTheSettlingTime) {
  // b = (2 * 15 / 0.1 + 4.6 * 5) / 0.895 = 360.9, and 360.9 / 5.4 = 66.8 rad/s
  const DriveTask task{0.895, 15, 5, 0};
  EXPECT_NEAR(SufficientBandwidth(task, {{20, 0.1}, {20, -0.1}}), 66.8, 0.1);
  // 4.6 / w + b / w^2 = 10 / w there
  const double w = SufficientBandwidth(task, {{20, 0.1}});
  const double b = (2 * 15 / 0.1 + 4.6 * 5) / 0.895;
  EXPECT_NEAR(4.6 / w + b / (w * w), 10 / w, 1e-12);
}

TEST(SufficientBandwidth, LeavesMostOfAShortHoldToItsSpeed) {
  // without friction 6.6 / w is to be a tenth of 0.5 s
  EXPECT_NEAR(SufficientBandwidth({1, 0, 0, 0}, {{0.5, 1}}), 6.6 / 0.05, 1e-9);
  // with it 6.6 / w + b / w^2 is, b = 2 * 3 / 1
  const double w = SufficientBandwidth({1, 3, 0, 0}, {{0.5, 1}});
  EXPECT_NEAR(6.6 / w + 6 / (w * w), 0.05, 1e-12);
}

TEST(SufficientBandwidth, HoldsAgainstGravityThatGrowsOnTheWay) {
  // K / (M w^2) = 1 %
  const double w = SufficientBandwidth({0.05, 0, 0, 1.962}, {{20, 0.2}});
  EXPECT_NEAR(1.962 / (0.05 * w * w), 0.01, 1e-12);
}

TEST(SufficientBandwidth, IsNotThatOfRestsAndOfAFewSlowPieces) {
  const DriveTask task{1, 10, 0, 0};
  EXPECT_EQ(SufficientBandwidth(task, {{60, 0}}), 0);
  EXPECT_EQ(SufficientBandwidth(task, {}), 0);
  const double fast = SufficientBandwidth(task, {{20, 1}});
  EXPECT_EQ(SufficientBandwidth(task, {{20, 1}, {100, 0}, {1, 0.01}}), fast);
  EXPECT_GT(SufficientBandwidth(task, {{20, 1}, {100, 0}, {2, 0.01}}), 10 * fast);
}

TEST(HoldsBetween, AreThePiecesOfOneVelocity) {
  const std::vector<MotionSegment> holds =
      HoldsBetween({{0, 0}, {1, 0.5}, {4, 0.5}, {5, -0.5}, {5.5, -0.5}});
  ASSERT_EQ(holds.size(), 2u);
  EXPECT_DOUBLE_EQ(holds[0].duration, 3);
  EXPECT_EQ(holds[1].velocity, -0.5);
}

}  // namespace
}  // namespace warmjoint
