#include "models/recording/measurements.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/recording.h>

#include <cmath>
#include <numbers>

#include "models/recording/mend.h"

namespace warmjoint {
namespace {

using Eigen::VectorXd;

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

constexpr double kTurn = 2 * std::numbers::pi;

VectorXd Wrapped(const VectorXd& position, double lowest) {
  VectorXd wrapped = position;
  for (double& p : wrapped) p -= kTurn * std::floor((p - lowest) / kTurn);
  return wrapped;
}

TEST(UndoJumps, FollowsSeveralTurnsInBothDirections) {
  const VectorXd time = VectorXd::LinSpaced(2000, 0, 20);
  const VectorXd position = 10 * (0.5 * time.array()).sin();
  for (const double lowest : {0.0, -kTurn / 2}) {
    VectorXd log = Wrapped(position, lowest);
    EXPECT_GE(UndoJumps(time, {}, 0, log), 4);
    // up to whole turns at the start, and their rounding
    EXPECT_LT(((log - position).array() - (log[0] - position[0])).abs().maxCoeff(), 1e-12);
  }
}

TEST(UndoJumps, LeavesOtherPositionsAlone) {
  const VectorXd time = VectorXd::LinSpaced(100, 0, 99);
  VectorXd position = 3 * (0.1 * time.array()).sin();
  const VectorXd before = position;
  EXPECT_EQ(UndoJumps(time, {}, 0, position), 0) << "never half a turn between samples";
  EXPECT_EQ(position, before);

  position = VectorXd::LinSpaced(100, 0, 400);
  EXPECT_EQ(UndoJumps(time, {}, 0, position), 0) << "more than one turn in all";
}

TEST(UndoJumps, BelievesTheVelocity) {
  // 4 rad each second, there and back: a step of more than half a turn that is no jump
  const VectorXd time = VectorXd::LinSpaced(5, 0, 4);
  VectorXd position(5), velocity(5);
  position << 0, 4, 0, 4, 0;
  velocity << 4, 0, 0, 0, -4;
  const VectorXd before = position;
  EXPECT_EQ(UndoJumps(time, velocity, 0, position), 2) << "a velocity of 0 asks for small steps";
  velocity << 4, 4, -12, 20, -28;
  position = before;
  EXPECT_EQ(UndoJumps(time, velocity, 0, position), 0);
  EXPECT_EQ(position, before);
}

/// To and fro between -3 and 3 rad at 1 rad/s, ten samples a second, without those of a span.
struct WithGap {
  VectorXd time, position, velocity;

  WithGap(double begin, double end) : time(600), position(600), velocity(600) {
    Eigen::Index n = 0;
    for (int i = 0; i < 600; ++i) {
      const double t = 0.1 * i, phase = std::fmod(t, 12);
      if (t > begin && t < end) continue;
      time[n] = t;
      position[n] = phase < 6 ? phase - 3 : 9 - phase;
      velocity[n++] = phase < 6 ? 1 : -1;
    }
    for (VectorXd* column : {&time, &position, &velocity}) column->conservativeResize(n);
  }
};

TEST(UndoJumps, TakesNoGapInWhichTheJointMovedForAJump) {
  WithGap log(17.5, 25);  // from 2.5 rad to -2
  const VectorXd before = log.position;
  ASSERT_LT((before.tail(before.size() - 1) - before.head(before.size() - 1)).minCoeff(),
            -kTurn / 2);
  EXPECT_EQ(UndoJumps(log.time, log.velocity, 0, log.position), 0);
  EXPECT_EQ(UndoJumps(log.time, {}, 0, log.position), 0);
  EXPECT_EQ(log.position, before);
}

TEST(UndoJumps, GoesOnAtTheNearestPlaceBehindAGapOfASensorThatWraps) {
  // 1 rad/s on and on; a gap of 4.5 s in which it turns by 4.5 rad: as well by 4.5 - 2 pi = -1.8 rad
  VectorXd time(155), velocity = VectorXd::Ones(155);
  for (Eigen::Index i = 0; i < 155; ++i) time[i] = 0.1 * static_cast<double>(i < 100 ? i : i + 44);
  VectorXd log = Wrapped(time, 0);
  EXPECT_GE(UndoJumps(time, velocity, 0, log), 2);
  EXPECT_NEAR(log[100] - log[99], 4.5 - kTurn, 1e-12);
  for (Eigen::Index i = 1; i < 155; ++i) {
    if (i == 100) continue;
    EXPECT_NEAR(log[i] - log[i - 1], 0.1, 1e-12) << i;
  }
}

}  // namespace
}  // namespace warmjoint
