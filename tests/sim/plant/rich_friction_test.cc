// Friction with maps, load and heat of two stages, in both plants.
#include <gtest/gtest.h>

#include <cmath>

#include "models/friction/joint_friction.h"
#include "scenarios/read_scenario.h"
#include "sim/plant/plant.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

Scenario Rich(const std::string& plant) {
  const std::string yaml = "plant: " + plant + R"(
robot: rotary
joint: hinge
friction:
  law: asymmetric
  parameters: {viscous: 2, coulomb_positive: 9, coulomb_negative: 11}
  thermal:
    thermal_gain: -0.4
    thermal_time_constant: 120
    second: {thermal_gain: -0.2, thermal_time_constant: 10}
  level_per_temperature: -0.1
  viscous_per_energy: 0.1
  load_gain: 0.1
  gear: 3
  maps:
    - axes:
        - quantity: motor_position
          centres: [0, 1.5707963267948966, 3.141592653589793, 4.71238898038469]
          width: 1.2
          period: 6.283185307179586
        - {quantity: velocity, centres: [-1, -0.4, 0.4, 1], width: 0.5, sides: apart}
      weights: [1, 2, -1, 0, 1, -1, 0.5, 1, 1, 2, -1, 0, 1, -1, 0.5, 1]
motion: {speeds: [0.3, 0.7], hold: 2, order: alternating}
disturbances: {ambient_temperature: {amplitude: 10, period: 20}}
sampling: {rate: 100, sensor_rate: 100}
timestep: 0.001
duration: 20
seed: 3
)";
  return ParseScenario(yaml, "rich");
}

// the engine holds on a spring of 0.1 M / h^2, M = 0.895 kg.m^2 and h = 1 ms, with levels below
// 20 N.m: between two directions it gives way by this much, and moves this much energy
constexpr double kStiffness = 0.1 * 0.895 / 1e-6;                       // N.m/rad
constexpr double kMostLevel = 20;                                       // N.m
constexpr double kWindUp = 2 * kMostLevel / kStiffness;                 // rad
constexpr double kWindUpEnergy = kMostLevel * kMostLevel / kStiffness;  // J

class RichFriction : public testing::TestWithParam<const char*> {};

TEST_P(RichFriction, IsTheForceOfTheModelAtEverySampleThatSlides) {
  const Scenario scenario = Rich(GetParam());
  const JointFriction model(scenario.friction);
  const Simulation recording = MakePlant(scenario)->Run(0);
  const Truth& truth = recording.truth;
  const Measurements& log = recording.measurements;
  ASSERT_TRUE(log.load) << "friction that depends on the load logs it";
  const double wind_up = truth.plant == "ideal" ? -1 : kWindUp;

  // a joint slides once it has moved by the wind-up in one direction
  Eigen::Index slides = 0, turned = 0;
  for (Eigen::Index i = 0; i < truth.force.size(); ++i) {
    const double v = truth.velocity[i];
    if (v * truth.velocity[turned] <= 0) turned = i;
    if (std::abs(log.position[i] - log.position[turned]) <= wind_up) continue;
    ++slides;
    const JointPlace place{log.position[i], truth.energy[i], (*log.load)[i]};
    // rounding of sums of a few terms of 10 N.m
    ASSERT_NEAR(truth.force[i], model.SlidingForce(v, place), 1e-12) << "sample " << i;
    ASSERT_LT(std::abs(truth.force[i]), kMostLevel);
  }
  // all but a few at each of ten reversals
  EXPECT_GT(slides, truth.force.size() * 9 / 10);
  EXPECT_LT(truth.energy.minCoeff(), -1) << "should be warm";
}

INSTANTIATE_TEST_SUITE_P(Plants, RichFriction, testing::Values("ideal", "mujoco"));

TEST(RichFriction, WarmsInTheEngineByTheLossOfEveryStep) {
  const Scenario scenario =
      WithSettings(Rich("mujoco"), {{"sampling.rate", "1000"}, {"sampling.sensor_rate", "1000"}});
  const Truth truth = MakePlant(scenario)->Run(0).truth;

  // (22) twice and (17) by hand, fed by W = |F v| of the recording
  const double h = 0.001, te = std::exp(-h / 120), te2 = std::exp(-h / 10);
  double first = 0, second = 0, worst = 0;
  for (Eigen::Index i = 0; i < truth.force.size(); ++i) {
    worst = std::max(worst, std::abs(truth.energy[i] - first - second));
    const double loss = std::abs(truth.force[i] * truth.velocity[i]);
    const double rise =
        scenario.disturbances.ambient_temperature.RiseAt(h * static_cast<double>(i));
    first = te * first + (1 - te) * (-0.4 * loss - 0.1 * rise);
    second = te2 * second - (1 - te2) * 0.2 * loss;
  }
  // what the spring takes and gives back at each of ten reversals warms nothing, but is in |F v|
  EXPECT_LT(worst, 10 * kWindUpEnergy * (0.4 / 120 + 0.2 / 10));
  EXPECT_LT(truth.energy.minCoeff(), -1) << "should be warm";
}

TEST(RichFriction, RefusesAnAmbientThatChangesNothingAndToPushInTheEngineToo) {
  Scenario scenario = Rich("mujoco");
  const auto set = [&] { WithSettings(scenario, {{"friction.level_per_temperature", "0"}}); };
  test::ExpectNamed(test::RefusalOf(set), {"ambient_temperature"});
  scenario.initial_energy = -30;
  test::ExpectNamed(test::RefusalOf([&] { MakePlant(scenario)->Run(0); }),
                    {"rich: ", "drives the joint", "thermal gain"});
}

}  // namespace
}  // namespace warmjoint
