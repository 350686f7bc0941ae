#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "models/foundation/serialize.h"
#include "scenarios/disturbances.h"
#include "scenarios/read_scenario.h"
#include "scenarios/scenario.h"
#include "tests/support/table1.h"

namespace warmjoint {
namespace {

/// Every field away from its default, with numbers that have no short decimal form.
Scenario Unusual() {
  Scenario scenario;
  scenario.name = "a \"name\": with # signs";
  scenario.plant = PlantKind::mujoco;
  scenario.joint_kind = JointKind::linear;
  scenario.robot = "linear_axis";
  scenario.joint = "slide";
  scenario.friction = {"asymmetric",
                       {{"viscous", 1.0 / 3}, {"coulomb_positive", 5}, {"coulomb_negative", 0.1}},
                       Thermal{-1e-5 / 7, 1e5 / 3},
                       20.1,
                       -1.0 / 9};
  scenario.draws.numbers["friction.parameters.coulomb_positive"] = {Distribution::Kind::uniform, 4,
                                                                    6};
  scenario.draws.numbers["initial_energy"] = {Distribution::Kind::normal, -0.1, 1.0 / 3};
  scenario.initial_energy = -0.1;
  scenario.motion.speeds.list = {0.1, 1.0 / 3, 1e-7};
  scenario.motion.travel.limits = {-1.0 / 3, 2.0 / 3};
  scenario.motion.order = SegmentOrder::shuffled;
  scenario.motion.rests = Rests{100.0 / 3, 1e3 / 7};
  scenario.controller = {31.4159265358979, 0.1};
  scenario.noise = {0.1, 1e-300, 5e-324};
  scenario.disturbances.outliers = {1.0 / 3, 5};
  scenario.disturbances.coloured_noise = {0.1, 10.0 / 3};
  scenario.disturbances.periodic_torque = {-0.7, 1.0 / 7};
  scenario.sampling = {20, 1000.0 / 3, 10.0 / 3};
  scenario.timestep = 1.0 / 512;
  scenario.duration = 1e3 / 3;
  scenario.seed = 18446744073709551615u;  // the largest
  return scenario;
}

Scenario ReadBack(const Scenario& scenario) {
  return ParseScenario(ScenarioToYaml(scenario), "written");
}

TEST(WriteScenario, ReadsBackBitForBit) {
  const Scenario scenario = Unusual();
  const Scenario back = ReadBack(scenario);
  EXPECT_EQ(back.name, scenario.name);
  EXPECT_EQ(back.plant, scenario.plant);
  EXPECT_EQ(back.joint_kind, scenario.joint_kind);
  EXPECT_EQ(back.robot, scenario.robot);
  EXPECT_EQ(back.joint, scenario.joint);
  EXPECT_EQ(back.friction.law, scenario.friction.law);
  EXPECT_EQ(back.friction.parameters, scenario.friction.parameters);
  EXPECT_EQ(back.friction.thermal->gain, scenario.friction.thermal->gain);
  EXPECT_EQ(back.friction.thermal->time_constant, scenario.friction.thermal->time_constant);
  EXPECT_EQ(back.friction.ambient, scenario.friction.ambient);
  EXPECT_EQ(back.friction.gear, scenario.friction.gear);
  EXPECT_EQ(back.initial_energy, scenario.initial_energy);
  EXPECT_EQ(back.timestep, scenario.timestep);
  EXPECT_EQ(back.duration, scenario.duration);
  EXPECT_EQ(back.seed, scenario.seed);
  EXPECT_EQ(WriteFields(back), WriteFields(scenario));
}

TEST(WriteScenario, IsAFixedPoint) {
  Scenario limits = test::Table1();
  limits.motion.hold = 0;
  limits.motion.travel.joint_limits = true;
  limits.friction.thermal.reset();
  Scenario phases = test::Table1();
  phases.motion = {};
  phases.motion.phases = {{100, test::Table1().motion}, {1.0 / 3, std::nullopt}};
  Scenario ideal_only = test::Table1();
  ideal_only.disturbances.gravity = {5, -1.0 / 3};
  ideal_only.disturbances.ambient_drift = {1, 7200};
  ideal_only.disturbances.load_change = {10, 0.1, 600};
  ideal_only.disturbances.second_heat = Thermal{-1.0 / 3, 60};
  Scenario corners = Unusual();
  corners.motion = {};
  corners.motion.corners = {{0, 1.0 / 3}, {0.1, 1.0 / 3}, {1e3 / 7, -1e-300}};
  corners.motion.start = -1.0 / 7;
  const Scenario fourier =
      WithSettings(test::Table1(),
                   {{"motion", "{fourier: {period: 10, harmonics: 5, speed: 1.5}, start: 0.2}"}});
  const Scenario moves = WithSettings(
      test::Table1(),
      {{"motion", "{moves: {between: [-1, 2], speed: 1, acceleration: 4, pause: 0.5}}"}});
  for (const Scenario& scenario :
       {Unusual(), test::Table1(), limits, phases, ideal_only, corners, fourier, moves}) {
    EXPECT_EQ(ScenarioToYaml(ReadBack(scenario)), ScenarioToYaml(scenario));
  }
}

TEST(WriteScenario, WithSettingsChangesOnlyWhatTheyName) {
  Scenario expected = Unusual();
  expected.noise.torque = 3;
  EXPECT_EQ(ScenarioToYaml(WithSettings(Unusual(), {{"noise.torque", "3"}})),
            ScenarioToYaml(expected));
}

Scenario Drawn() {
  return WithSettings(test::Table1(),
                      {{"friction.parameters.viscous", "{uniform: [4, 6]}"},
                       {"friction.thermal.thermal_time_constant", "{log_uniform: [100, 1000]}"},
                       {"initial_energy", "{normal: [-1, 0.5]}"}});
}

TEST(Realize, LeavesAScenarioWithoutDrawsAsItIs) {
  EXPECT_EQ(ScenarioToYaml(Realize(test::Table1(), 5)), ScenarioToYaml(test::Table1()));
}

TEST(Realize, DrawsEachTruthFromItsDistribution) {
  // 500 draws; sd of the means: 0.577 / sqrt(n), 0.665 / sqrt(n), 0.5 / sqrt(n); bounds 5 sd
  const int n = 500;
  double viscous = 0, log_time = 0, energy = 0;
  for (int i = 0; i < n; ++i) {
    const Scenario one = Realize(Drawn(), static_cast<std::uint64_t>(i));
    EXPECT_TRUE(one.draws.empty());
    EXPECT_EQ(one.friction.parameters.at("coulomb"), 15);
    const double kv = one.friction.parameters.at("viscous");
    EXPECT_TRUE(kv >= 4 && kv < 6) << kv;
    viscous += kv / n;
    log_time += std::log(one.friction.thermal->time_constant) / n;
    energy += one.initial_energy / n;
  }
  const double root = std::sqrt(double(n));
  EXPECT_NEAR(viscous, 5, 5 * 0.577 / root);
  EXPECT_NEAR(log_time, (std::log(100) + std::log(1000)) / 2, 5 * 0.665 / root);
  EXPECT_NEAR(energy, -1, 5 * 0.5 / root);
}

TEST(Realize, RepeatsTheTruthOfARealization) {
  EXPECT_EQ(ScenarioToYaml(Realize(Drawn(), 3)), ScenarioToYaml(Realize(Drawn(), 3)));
  EXPECT_NE(ScenarioToYaml(Realize(Drawn(), 3)), ScenarioToYaml(Realize(Drawn(), 4)));
}

TEST(Disturbances, AreWrittenWhereAnyOfThemIsNotAtItsDefault) {
  // one number of each member
  const std::vector<std::function<void(Disturbances&)>> changes{
      [](Disturbances& d) { d.outliers.fraction = 0.1; },
      [](Disturbances& d) { d.coloured_noise.deviation = 0.1; },
      [](Disturbances& d) { d.uneven_noise.of_speed = 0.1; },
      [](Disturbances& d) { d.periodic_torque.amplitude = 0.1; },
      [](Disturbances& d) { d.gravity.sine = 0.1; },
      [](Disturbances& d) { d.ambient_drift.amplitude = 0.1; },
      [](Disturbances& d) { d.ambient_temperature.amplitude = 0.1; },
      [](Disturbances& d) { d.load_change.load = 0.1; },
      [](Disturbances& d) { d.torque_lag.time_constant = 0.1; },
      [](Disturbances& d) { d.velocity_filter.time_constant = 0.1; },
      [](Disturbances& d) { d.stale_position.samples = 1; },
      [](Disturbances& d) { d.encoder.resolution = 0.1; },
      [](Disturbances& d) { d.hold_parity.level = 0.1; },
      [](Disturbances& d) { d.step_in_time.level = 0.1; },
      [](Disturbances& d) { d.run_in.level = 0.1; },
      [](Disturbances& d) { d.hidden.backlash.level = 0.1; },
      [](Disturbances& d) { d.faults.clock.factor = 1.1; },
      [](Disturbances& d) { d.without_velocity = true; },
      [](Disturbances& d) {
        d.second_heat = Thermal{-1, 60};
      },
  };
  EXPECT_TRUE(WriteFields(Disturbances{}).empty());
  for (size_t i = 0; i < changes.size(); ++i) {
    Disturbances changed;
    changes[i](changed);
    EXPECT_FALSE(WriteFields(changed).empty()) << "member " << i;
  }
}

}  // namespace
}  // namespace warmjoint
