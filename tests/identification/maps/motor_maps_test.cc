#include "identification/maps/motor_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/judging.h"

namespace warmjoint {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;  // rad
constexpr double kGear = 4.8332;

TEST(MotorMaps, LeaveTheHeatToTheWarmingOfAJointThatWanders) {
  FrictionDescription friction = test::TableOne();
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
