#include "models/recording/unwrap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace warmjoint {
namespace {

using Eigen::VectorXd;

constexpr double kTurn = 2 * std::numbers::pi;

VectorXd Wrapped(const VectorXd& position, double lowest) {
  VectorXd wrapped = position;
  for (double& p : wrapped) p -= kTurn * std::floor((p - lowest) / kTurn);
  return wrapped;
}

TEST(UnwrapTurns, FollowsSeveralTurnsInBothDirections) {
  const VectorXd time = VectorXd::LinSpaced(2000, 0, 20);
  const VectorXd position = 10 * (0.5 * time.array()).sin();
  for (const double lowest : {0.0, -kTurn / 2}) {
    VectorXd log = Wrapped(position, lowest);
    EXPECT_GE(UnwrapTurns(time, {}, log), 4);
    // up to whole turns at the start, and their rounding
    EXPECT_LT(((log - position).array() - (log[0] - position[0])).abs().maxCoeff(), 1e-12);
  }
}

TEST(UnwrapTurns, LeavesOtherPositionsAlone) {
  const VectorXd time = VectorXd::LinSpaced(100, 0, 99);
  VectorXd position = 3 * (0.1 * time.array()).sin();
  const VectorXd before = position;
  EXPECT_EQ(UnwrapTurns(time, {}, position), 0) << "never half a turn between samples";
  EXPECT_EQ(position, before);

  position = VectorXd::LinSpaced(100, 0, 400);
  EXPECT_EQ(UnwrapTurns(time, {}, position), 0) << "more than one turn in all";
}

TEST(UnwrapTurns, BelievesTheVelocity) {
  // 4 rad each second, there and back: a step of more than half a turn that is no jump
  const VectorXd time = VectorXd::LinSpaced(5, 0, 4);
  VectorXd position(5), velocity(5);
  position << 0, 4, 0, 4, 0;
  velocity << 4, 0, 0, 0, -4;
  const VectorXd before = position;
  EXPECT_EQ(UnwrapTurns(time, velocity, position), 2) << "a velocity of 0 asks for small steps";
  velocity << 4, 4, -12, 20, -28;
  position = before;
  EXPECT_EQ(UnwrapTurns(time, velocity, position), 0);
  EXPECT_EQ(position, before);
}

}  // namespace
}  // namespace warmjoint
