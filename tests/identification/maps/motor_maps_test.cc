#include "identification/maps/motor_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/judging.h"

namespace warmjoint {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;  // rad
constexpr double kGear = 4.8332;

/// Samples spread evenly over a travel, with two speeds. travel: rad or m
MapPoints Over(double travel) {
  MapPoints points = MapPoints::Zero(100, 5);
  for (Eigen::Index i = 0; i < 100; ++i) {
    const double x = travel * static_cast<double>(i) / 99;
    points.row(i) << x, kGear * x, (i % 2 == 0 ? 0.5 : -0.8), 0, 0;
  }
  return points;
}

/// The axis of the joint's map.
GaussianAxis ArmAxis(JointKind joint, double travel) {
  return MotorMaps({36, 3, 20}, {.width = 1}, joint, Over(travel)).at(0).at(1).axes.at(0).kernels;
}

TEST(MotorMaps, TheJointsGoesOverItsTravel) {
  for (const double turns : {0.3, 1.5, 6.0}) {
    const GaussianAxis axis = ArmAxis(JointKind::rotary, turns * kTurn);
    EXPECT_FALSE(axis.period) << turns;
    EXPECT_DOUBLE_EQ(axis.centres.back(), turns * kTurn);
  }
  EXPECT_FALSE(ArmAxis(JointKind::linear, 100).period);
}

TEST(MotorMaps, TheJointsGoesOverATurnWhereFewerThanThreeOfItsKernelsFallOnOne) {
  const GaussianAxis axis = ArmAxis(JointKind::rotary, 7 * kTurn);
  ASSERT_TRUE(axis.period);
  EXPECT_DOUBLE_EQ(*axis.period, kTurn);
  EXPECT_EQ(axis.size(), 20u);
}

TEST(MotorMaps, LeaveTheHeatToTheWarmingOfAJointThatWanders) {
  Friction friction = test::TableOne();
  friction.gear = kGear;
  FrictionMap ripple{{{MapQuantity::motor_position, CircleAxis(kTurn, 12)}},
                     KernelKind::normalised,
                     {},
                     MapFactor::direction};
  for (int i = 0; i < 12; ++i) ripple.weights.push_back(0.7 * std::cos(kTurn * i / 12));
  friction.maps = {ripple};
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Measurements m = test::RecordHour(friction, seed);
    m.gear = kGear;
    const Estimate estimate = test::Answer("energy-ml", m, {{"position", "motor"}});
    ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
    for (const auto& [name, truth] :
         {std::pair{"thermal_gain", -3.0}, std::pair{"thermal_time_constant", 600.0}}) {
      // 4 of its own standard deviations, which a map that follows the wandering makes ten times as large
      const EstimatedParameter& found = *estimate.Find(name);
      EXPECT_NEAR(found.value, truth, 4 * *found.std) << name << ", seed " << seed;
      EXPECT_LT(*found.std, 0.02 * std::abs(truth)) << name << ", seed " << seed;
    }
  }
}

}  // namespace
}  // namespace warmjoint
