#include <gtest/gtest.h>
#include <warmjoint/friction_model.h>

#include <cmath>
#include <numbers>

#include "models/friction/joint_friction.h"

namespace warmjoint {
namespace {

Friction Asymmetric(double gain) {
  Friction friction;
  friction.law = "asymmetric";
  friction.parameters = {{"viscous", 2}, {"coulomb_positive", 5}, {"coulomb_negative", 7}};
  friction.thermal = Thermal{gain, 30};
  return friction;
}

TEST(SettledEnergy, IsTheClosedFormOfALawAlone) {
  for (const double gain : {-0.3, -5.0, 0.2}) {
    for (const auto& [v, force] : {std::pair(0.7, 2 * 0.7 + 5), std::pair(-0.7, 2 * 0.7 + 7)}) {
      const auto energy = SettledEnergy(Asymmetric(gain), v);
      ASSERT_TRUE(energy);
      ASSERT_EQ(energy->size(), 1u);
      const double k = gain * std::abs(v);
      // a bisection ends within a few units in the last place
      EXPECT_NEAR(energy->front(), k * force / (1 - k), 1e-14 * (1 + std::abs(energy->front())));
    }
  }
}

TEST(SettledEnergy, IsWhereTwoStagesEndUp) {
  Friction friction = Asymmetric(-0.2);
  friction.second_thermal = Thermal{-0.1, 300};
  friction.viscous_per_energy = 0.05;
  const auto energy = SettledEnergy(friction, 0.9);
  ASSERT_TRUE(energy);

  // the model itself, stepped through twenty of the slower time constants: exp(-20) is 2e-9
  JointFriction joint(friction);
  joint.SetTimestep(0.05);
  FrictionState state;
  for (int i = 0; i < 120000; ++i) {
    state = joint.Step(state, {.velocity = 0.9, .inertia = 100}).next;
  }
  EXPECT_NEAR(energy->at(0), state.energy, 1e-8);
  EXPECT_NEAR(energy->at(1), state.second_energy, 1e-8);
}

TEST(SettledEnergy, AveragesAMapOverTheMotorsTurn) {
  Friction friction = Asymmetric(-0.3);
  friction.gear = 50;
  FrictionMap ripple;
  ripple.axes = {{MapQuantity::motor_position, CircleAxis(2 * std::numbers::pi, 12)}};
  for (int i = 0; i < 12; ++i) ripple.weights.push_back(1 + std::sin(i * std::numbers::pi / 6));
  friction.maps = {ripple};
  const auto energy = SettledEnergy(friction, 0.5);
  ASSERT_TRUE(energy);
  // the kernels of an even circle are alike, so that the mean of the map is that of its weights, 1
  const double k = -0.3 * 0.5;
  EXPECT_NEAR(energy->front(), k * (2 * 0.5 + 5 + 1) / (1 - k), 1e-9);
}

TEST(SettledEnergy, IsNoneWithoutHeatAndNothingWhereLossesGrowForEver) {
  Friction cold = Asymmetric(-1);
  cold.thermal.reset();
  EXPECT_EQ(SettledEnergy(cold, 1), std::vector<double>{});
  EXPECT_EQ(SettledEnergy(Asymmetric(2), 0.5), std::nullopt);
}

TEST(SettledEnergy, IsZeroAtRest) {
  EXPECT_EQ(SettledEnergy(Asymmetric(-0.3), 0), std::vector<double>{0});
}

}  // namespace
}  // namespace warmjoint
