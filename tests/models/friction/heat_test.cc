#include <gtest/gtest.h>
#include <warmjoint/friction_model.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "models/friction/joint_friction.h"
#include "models/friction/thermal.h"
#include "tests/support/shared_data.h"

namespace warmjoint {
namespace {

// closed forms hold to 1e-12 relative (golden/README)
constexpr double kClosedForm = 1e-12;

void ExpectClose(double value, double expected) {
  EXPECT_NEAR(value, expected, kClosedForm * std::abs(expected));
}

TEST(Thermal, DiscretisesAsTheGoldenPairs) {
  const auto& golden = test::Golden()["c2d"];
  const auto check = [](const nlohmann::json& inp, double ke, double te) {
    const DiscreteThermal pair = Discretise({inp["kbar"], inp["tbar"]}, inp["h"]);
    ExpectClose(pair.gain, ke);
    ExpectClose(pair.pole, te);
  };
  check(golden["inp"], golden["ke"], golden["te"]);
  check(golden["yumi"]["inp"], golden["yumi"]["ke"], golden["yumi"]["te"]);
}

TEST(Thermal, ContinuousUndoesDiscretise) {
  for (double tau : {0.5, 180.0, 600.0, 1e5}) {
    const Thermal back = Continuous(Discretise({-3, tau}, 1.0), 1.0);
    // 1 - te loses log10(tau / h) digits
    EXPECT_NEAR(back.time_constant, tau, 4e-16 * tau * tau + 1e-13 * tau);
    EXPECT_NEAR(back.gain, -3, 1e-15 * tau * 3 + 1e-13);
  }
}

TEST(Thermal, StepFollowsTheGoldenFilter) {
  const auto& golden = test::Golden()["filter"];
  const double ke = golden["ke"], te = golden["te"];
  double energy = golden["E0"];
  for (size_t i = 0; i < golden["W"].size(); ++i) {
    ExpectClose(energy, golden["E"][i]);
    energy = ThermalStep<double, double>(ke, te, energy, golden["W"][i]);
  }
}

TEST(Thermal, SettlesWhereTheContinuousFormulaSays) {
  // E settles at k v F0 / (1 - k v), whatever the step (paper, feedback of W through E)
  const double v = 0.5, k = -3, nominal = 17.5;
  for (double h : {0.001, 1.0, 15.0}) {
    const DiscreteThermal thermal = Discretise({k, 600}, h);
    double energy = 0;
    for (int i = 0; i < 20 * 240 / h; ++i) {
      const double loss = Loss(v, WarmForce(v, nominal, energy));
      energy = ThermalStep(thermal.gain, thermal.pole, energy, loss);
    }
    EXPECT_NEAR(energy, k * v * nominal / (1 - k * v), 1e-6);
  }
}

TEST(Thermal, KnowsWhenFrictionPushes) {
  EXPECT_FALSE(DrivesJoint(0.5, WarmForce(0.5, 17.5, -10.0)));
  EXPECT_TRUE(DrivesJoint(0.5, WarmForce(0.5, 17.5, -18.0)));
  EXPECT_TRUE(DrivesJoint(-0.5, WarmForce(-0.5, -17.5, -18.0)));
  EXPECT_FALSE(DrivesJoint(0.0, 0.0));
}

Friction TwoStages() {
  Friction friction{"coulomb", {{"coulomb", 10}}, Thermal{-3, 600}};
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

Friction AsymmetricFriction(double gain) {
  return {"asymmetric",
          {{"viscous", 2}, {"coulomb_positive", 5}, {"coulomb_negative", 7}},
          Thermal{gain, 30}};
}

TEST(SettledEnergy, IsTheClosedFormOfALawAlone) {
  for (const double gain : {-0.3, -5.0, 0.2}) {
    for (const auto& [v, force] : {std::pair(0.7, 2 * 0.7 + 5), std::pair(-0.7, 2 * 0.7 + 7)}) {
      const auto energy = SettledEnergy(AsymmetricFriction(gain), v);
      ASSERT_TRUE(energy);
      ASSERT_EQ(energy->size(), 1u);
      const double k = gain * std::abs(v);
      // a bisection ends within a few units in the last place
      EXPECT_NEAR(energy->front(), k * force / (1 - k), 1e-14 * (1 + std::abs(energy->front())));
    }
  }
}

TEST(SettledEnergy, IsWhereTwoStagesEndUp) {
  Friction friction = AsymmetricFriction(-0.2);
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
  Friction friction = AsymmetricFriction(-0.3);
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

TEST(SettledEnergy, IsZeroAtRestNoneWithoutHeatAndNothingWhereLossesGrowForEver) {
  EXPECT_EQ(SettledEnergy(AsymmetricFriction(-0.3), 0), std::vector<double>{0});
  Friction cold = AsymmetricFriction(-1);
  cold.thermal.reset();
  EXPECT_EQ(SettledEnergy(cold, 1), std::vector<double>{});
  EXPECT_EQ(SettledEnergy(AsymmetricFriction(2), 0.5), std::nullopt);
}

}  // namespace
}  // namespace warmjoint
