#include "sim/plant/velocity_drive.h"

#include <gtest/gtest.h>

#include <cmath>

namespace warmjoint {
namespace {

TEST(VelocityReference, HasSettledWhenASegmentBegins) {
  // 2 s at 1, 2 s at -1, 1 s of rest; ramps of 4 rad/s^2, 0.1 s to settle
  VelocityReference reference({{2, 1}, {2, -1}, {1, 0}}, 4, 0.1);
  EXPECT_DOUBLE_EQ(reference.begin(), -0.35);
  EXPECT_EQ(reference.Velocity(-0.35), 0);
  EXPECT_DOUBLE_EQ(reference.Velocity(-0.225), 0.5);
  EXPECT_EQ(reference.Velocity(-0.05), 1);
  EXPECT_EQ(reference.acceleration(), 0);
  EXPECT_EQ(reference.Velocity(1.4), 1);
  EXPECT_NEAR(reference.Velocity(1.65), 0, 1e-14);
  EXPECT_EQ(reference.acceleration(), -4);
  EXPECT_NEAR(reference.Velocity(1.9), -1, 1e-14);
  EXPECT_EQ(reference.Velocity(3.9), 0);
  EXPECT_EQ(reference.Velocity(9), 0);
}

TEST(VelocityReference, KnowsTheRunUpOfRampsThatFollowOnEachOther) {
  // 0.02 s to 0.1, at once 0.22 s to -1, and 0.28 s at full speed
  VelocityReference reference({{0.05, 0.1}, {2, -1}}, 5, 0.5);
  EXPECT_NEAR(reference.run_up(), 0.02 * 0.05 - 0.22 * 0.45 - 0.28, 1e-15);
  EXPECT_DOUBLE_EQ(reference.Velocity(-0.5), 0.1);
  EXPECT_EQ(reference.acceleration(), -5);
}

TEST(VelocityReference, GoesThroughCornersAndHasSettledOnTheFirst) {
  auto reference = VelocityReference::Through({{0, 1}, {2, 1}, {3, -1}}, 4, 0.1);
  EXPECT_DOUBLE_EQ(reference.begin(), -0.35);
  EXPECT_DOUBLE_EQ(reference.run_up(), 0.125 + 0.1);
  EXPECT_EQ(reference.Velocity(-0.05), 1);
  EXPECT_EQ(reference.Velocity(1.5), 1);
  EXPECT_DOUBLE_EQ(reference.Velocity(2.25), 0.5);
  EXPECT_EQ(reference.acceleration(), -2);
  EXPECT_EQ(reference.Velocity(9), -1);
}

TEST(VelocityReference, KeepsTheOrderOfRampsInShortSegments) {
  VelocityReference reference({{1, 1}, {0.1, -1}, {1, 1}}, 4, 0.1);
  double before = reference.Velocity(reference.begin());
  for (double time = reference.begin(); time < 2.5; time += 0.01) {
    const double velocity = reference.Velocity(time);
    EXPECT_LE(std::abs(velocity - before), 4 * 0.01 + 1e-12);
    before = velocity;
  }
  EXPECT_EQ(before, 1);
}

TEST(VelocityDrive, TakesUpAConstantLoadWithoutAnErrorLeft) {
  // a joint of 2 kg.m^2 with 3 N.m against it, 1 s at 50 rad/s: e^-50 is left
  VelocityDrive drive(2, 50, 0.001);
  double v = 0, torque = 0;
  for (int i = 0; i < 1000; ++i) {
    torque = drive.Torque(0.5, 0, v);
    v += 0.001 * (torque - 3) / 2;
  }
  EXPECT_NEAR(v, 0.5, 1e-12);
  EXPECT_NEAR(torque, 3, 1e-9);
}

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
