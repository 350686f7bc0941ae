#include "models/recording/measurements.h"

#include <gtest/gtest.h>
#include <warmjoint/recording.h>

#include "models/recording/sampling.h"

namespace warmjoint {
namespace {

TEST(KnowsMotorAngle, NeedsAColumnOrAGearThatTurnsTheMotorFurther) {
  Measurements m;
  m.position = Eigen::Vector3d(0, 1, 3);
  for (const double gear : {1.0, -1.0}) {
    m.gear = gear;
    EXPECT_FALSE(KnowsMotorAngle(m)) << gear;
  }
  for (const double gear : {-100.0, 0.5, 50.0}) {
    m.gear = gear;
    EXPECT_TRUE(KnowsMotorAngle(m)) << gear;
  }
  EXPECT_EQ(MotorPosition(m), Eigen::Vector3d(0, 50, 150));

  // a column counts whatever the gear, and more than it
  m.gear = 1;
  m.motor_position = Eigen::Vector3d(0, 7, 21);
  EXPECT_TRUE(KnowsMotorAngle(m));
  EXPECT_EQ(MotorPosition(m), Eigen::Vector3d(0, 7, 21));
}

TEST(LongestStep, IsThreeMedianSteps) {
  Eigen::VectorXd time(6);
  time << 0, 0.1, 0.2, 0.3, 0.4, 100;
  EXPECT_DOUBLE_EQ(LongestStep(time), 3 * (0.3 - 0.2));
}

TEST(WithoutRest, LeavesOutSamplesOfVelocityZeroAlone) {
  Measurements m;
  m.velocity = Eigen::Vector4d(0, 1, -1e-9, 2);
  Selection selection;
  selection.segments = {{0, 4, 1}};
  selection.keep.resize(4);
  selection.keep << true, true, true, false;
  const Selection moving = WithoutRest(selection, m);
  EXPECT_FALSE(moving.keep[0]);
  EXPECT_TRUE(moving.keep[1]);
  EXPECT_TRUE(moving.keep[2]);
  EXPECT_FALSE(moving.keep[3]);
  EXPECT_EQ(moving.segments.size(), 1u);
}

}  // namespace
}  // namespace warmjoint
