#include "models/friction/heat.h"

#include <gtest/gtest.h>

namespace warmjoint {
namespace {

Friction TwoStages() {
  Friction friction;
  friction.law = "coulomb";
  friction.parameters = {{"coulomb", 10}};
  friction.thermal = Thermal{-3, 600};
  friction.second_thermal = Thermal{-1, 20};
  friction.level_per_temperature = -0.2;
  return friction;
}

TEST(Heat, FollowsTheTemperatureFormAtAnyStep) {
  // (17) with constant loss and surroundings: T - T0 rises to Ts - T0 + R W, R = k / kT, with tau
  const double loss = 2, rise = 8, resistance = -3 / -0.2;
  for (const double h : {0.001, 1.0, 250.0}) {
    const Heat heat = DiscretiseHeat(TwoStages(), h);
    double energy = 0;
    const int steps = static_cast<int>(500 / h);
    for (int i = 0; i < steps; ++i) energy = heat.First(energy, {loss, rise});
    const double temperature = energy / -0.2;
    const double expected = (rise + resistance * loss) * -std::expm1(-500.0 / 600);
    // the last bit of te over 5e5 steps of 1 - te = 2e-6: 1e-16 / 2e-6
    EXPECT_NEAR(temperature, expected, 1e-10 * expected) << "step " << h;
  }
}

TEST(Heat, FeedsBothStagesWithTheSameLoss) {
  const Heat heat = DiscretiseHeat(TwoStages(), 1);
  double first = 0, second = 0;
  for (int i = 0; i < 20000; ++i) {
    first = heat.First(first, {2});
    second = heat.Second(second, {2});
  }
  // each settles at its gain times the loss; 20000 s are 33 time constants
  EXPECT_NEAR(first, -6, 1e-12);
  EXPECT_NEAR(second, -2, 1e-14);
}

TEST(Heat, LeavesColdJointsAsTheyAre) {
  Friction friction = TwoStages();
  friction.thermal.reset();
  friction.second_thermal.reset();
  const Heat heat = DiscretiseHeat(friction, 1);
  EXPECT_EQ(heat.First(-4, {100}), -4);
  EXPECT_EQ(heat.Second(0, {100}), 0);
}

}  // namespace
}  // namespace warmjoint
