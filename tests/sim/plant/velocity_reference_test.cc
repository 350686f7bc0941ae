#include "sim/plant/velocity_drive.h"

#include <gtest/gtest.h>


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

TEST(VelocityReference, KnowsItsRunUp) {
  // a triangle of 0.25 s and 0.1 s at full speed
  EXPECT_DOUBLE_EQ(VelocityReference({{2, 1}, {2, -1}}, 4, 0.1).run_up(), 0.125 + 0.1);
  EXPECT_DOUBLE_EQ(VelocityReference({{2, -1}}, 4, 0.1).run_up(), -0.225);
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

TEST(VelocityReference, StaysAtRestWithoutMotion) {
  VelocityReference reference({{3, 0}}, 4, 0.1);
  EXPECT_EQ(reference.begin(), 0);
  EXPECT_EQ(reference.run_up(), 0);
  EXPECT_EQ(reference.Velocity(1), 0);
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

}  // namespace
}  // namespace warmjoint
