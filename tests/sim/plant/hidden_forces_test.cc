#include "sim/plant/disturb_log.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace warmjoint {
namespace {

using Eigen::VectorXd;

constexpr double kStep = 0.01;  // s

/// To and fro at 0.5 rad/s, 4 s each way.
struct ToAndFro {
  VectorXd time = VectorXd::LinSpaced(1601, 0, 16);
  VectorXd velocity, position;

  ToAndFro() {
    velocity = time.unaryExpr([](double t) { return std::fmod(t + 1e-9, 8) < 4 ? 0.5 : -0.5; });
    position = VectorXd::Zero(time.size());
    for (Eigen::Index i = 1; i < time.size(); ++i) {
      position[i] = position[i - 1] + kStep * velocity[i - 1];
    }
  }
  VectorXd Torque(const Disturbances& disturbances) const {
    return HiddenTorque(disturbances, time, velocity, position);
  }
};

TEST(HiddenForces, NoneByDefault) { EXPECT_EQ(ToAndFro().Torque({}).cwiseAbs().maxCoeff(), 0); }

TEST(HiddenForces, BacklashLacksItsLevelOverItsWay) {
  Disturbances d;
  d.hidden.backlash = {3, 0.4};
  const VectorXd torque = ToAndFro().Torque(d);
  // 0.4 rad take 0.8 s; the sample of the turn has still gone nothing
  EXPECT_EQ(torque[400], 3);
  EXPECT_EQ(torque[479], 3);
  EXPECT_EQ(torque[481], 0);
  EXPECT_EQ(torque[801], -3);
}

TEST(HiddenForces, HysteresisDiesAwayWithTheWay) {
  Disturbances d;
  d.hidden.hysteresis = {3, 0.2};
  const VectorXd torque = ToAndFro().Torque(d);
  for (const int k : {0, 10, 100}) {
    EXPECT_NEAR(torque[400 + k], 3 * std::exp(-0.5 * kStep * k / 0.2), 1e-9) << k;
  }
}

TEST(HiddenForces, MemoryFollowsTheSpeedLate) {
  ToAndFro motion;
  motion.velocity.tail(801).setConstant(1);  // from 0.5 to 1 in size
  Disturbances d;
  d.hidden.memory = {4, 0.5};
  const VectorXd torque = motion.Torque(d);
  EXPECT_EQ(torque[700], 0);
  for (const int k : {1, 50, 200}) {
    EXPECT_NEAR(torque[800 + k], -4 * 0.5 * std::exp(-kStep * k / 0.5), 1e-9) << k;
  }
}

TEST(HiddenForces, DragRippleAndSpringAreFormulas) {
  const ToAndFro motion;
  Disturbances d;
  d.hidden.quadratic_drag.coefficient = 2;
  d.hidden.ripple = {0.3, 0.7};
  d.hidden.spring.stiffness = 5;
  const VectorXd torque = motion.Torque(d);
  for (const int i : {37, 700, 1200}) {
    const double v = motion.velocity[i], p = motion.position[i];
    const double ripple = 0.3 * std::sin(2 * std::numbers::pi * p / 0.7);
    EXPECT_NEAR(torque[i], 2 * v * std::abs(v) + std::copysign(1, v) * ripple + 5 * p, 1e-12);
  }
}

TEST(HiddenForces, InertiaActsWhileTheSpeedChanges) {
  ToAndFro motion;
  motion.velocity = 0.2 * motion.time;
  Disturbances d;
  d.hidden.inertia.inertia = 3;
  EXPECT_NEAR(motion.Torque(d)[500], 0.6, 1e-9);
}

}  // namespace
}  // namespace warmjoint
