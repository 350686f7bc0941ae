#include "identification/lack_of_fit/one_speed.h"

#include <gtest/gtest.h>

#include "tests/support/vectors.h"

namespace warmjoint {
namespace {

/// Forwards at one speed and backwards at another, with a rest between.
Measurements BackAndForth(double forwards, double backwards) {
  Eigen::VectorXd velocity = Eigen::VectorXd::Zero(300);
  velocity.head(120).setConstant(forwards);
  velocity.tail(120).setConstant(-backwards);
  return test::Record(0.1, velocity, velocity);
}

TEST(OneSpeed, IsKnownWhereBothDirectionsShareIt) {
  const auto speed = OneSpeed(BackAndForth(0.5, 0.5));
  ASSERT_TRUE(speed);
  EXPECT_EQ(*speed, 0.5);
}

TEST(OneSpeed, IsNoneOfSpeedsThatDiffer) {
  EXPECT_FALSE(OneSpeed(BackAndForth(0.5, 0.6)));
  EXPECT_TRUE(OneSpeed(BackAndForth(0.5, 0.505))) << "by 1 %";
}

TEST(OneSpeed, IsNoneOfAJointAtRest) { EXPECT_FALSE(OneSpeed(BackAndForth(0, 0))); }

}  // namespace
}  // namespace warmjoint
