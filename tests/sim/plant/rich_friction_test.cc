// Friction with maps, load and heat of two stages, in both plants.
#include <gmock/gmock.h>

#include <cmath>

#include "models/foundation/bad_input.h"
#include "models/friction/joint_friction.h"
#include "scenarios/read_scenario.h"
#include "sim/plant.h"

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
  return ReadScenarioValue(YamlValue::Parse(yaml, "rich", {}), "rich");
}

class RichFriction : public testing::TestWithParam<const char*> {};

TEST_P(RichFriction, IsTheForceOfTheModelAtEverySampleThatSlides) {
  const Scenario scenario = Rich(GetParam());
  const JointFriction model(scenario.friction);
  const Recording recording = MakePlant(scenario)->Run(0);
  const Truth& truth = recording.truth;
  const Measurements& log = recording.measurements;
  ASSERT_TRUE(log.load) << "friction that depends on the load logs it";

  int held = 0;
  for (Eigen::Index i = 0; i < truth.force.size(); ++i) {
    const double v = truth.velocity[i];
    const JointPlace place{log.position[i], truth.energy[i], (*log.load)[i]};
    // rounding of sums of a few terms of 10 N.m
    if (std::abs(truth.force[i] - model.SlidingForce(v, place)) > 1e-12) ++held;
  }
  // at each of ten reversals the engine's joint rests until the controller has turned its torque
  // by 20 N.m, in two times of its loop of 20 rad/s: 0.1 s, ten samples
  EXPECT_LE(held, truth.plant == "ideal" ? 0 : 100);
  EXPECT_LT(truth.energy.minCoeff(), -1) << "should be warm";
}

INSTANTIATE_TEST_SUITE_P(Plants, RichFriction, testing::Values("ideal", "mujoco"));

TEST(RichFriction, WarmsInTheEngineAsInTheFormulas) {
  const Recording ideal = MakePlant(Rich("ideal"))->Run(0);
  const Recording engine = MakePlant(Rich("mujoco"))->Run(0);
  // the engine ramps between speeds: 0.25 s or so of up to 7 W in ten reversals, of each
  // 0.4 / 120 + 0.2 / 10 N.m per J
  const double allowed = 10 * 0.25 * 7 * (0.4 / 120 + 0.2 / 10);
  EXPECT_NEAR(engine.truth.energy[1999], ideal.truth.energy[1999], allowed);
  EXPECT_LT(allowed, 0.5 * std::abs(ideal.truth.energy[1999]));
}

TEST(RichFriction, RefusesAnAmbientTemperatureThatChangesNothing) {
  Scenario scenario = Rich("ideal");
  EXPECT_THAT(
      [&] {
        WithSettings(scenario, {{"friction.level_per_temperature", "0"}});
      },
      testing::ThrowsMessage<BadInput>(testing::HasSubstr("ambient_temperature changes nothing")));
}

TEST(RichFriction, RefusesToPushInTheEngineToo) {
  Scenario scenario = Rich("mujoco");
  scenario.initial_energy = -30;
  EXPECT_THAT([&] { MakePlant(scenario)->Run(0); },
              testing::ThrowsMessage<BadInput>(testing::HasSubstr("friction feeds itself")));
}

}  // namespace
}  // namespace warmjoint
