#include "models/recording/motor_angle.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace warmjoint
