#include <gtest/gtest.h>

#include "scenarios/read_scenario.h"
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
  scenario.motion.speed_list = {0.1, 1.0 / 3, 1e-7};
  scenario.motion.travel = {-1.0 / 3, 2.0 / 3};
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
  scenario.seed = 9223372036854775807;
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
  EXPECT_EQ(back.draws, scenario.draws);
  EXPECT_EQ(back.initial_energy, scenario.initial_energy);
  EXPECT_EQ(back.motion, scenario.motion);
  EXPECT_EQ(back.controller, scenario.controller);
  EXPECT_EQ(back.noise, scenario.noise);
  EXPECT_EQ(back.disturbances, scenario.disturbances);
  EXPECT_EQ(back.sampling, scenario.sampling);
  EXPECT_EQ(back.timestep, scenario.timestep);
  EXPECT_EQ(back.duration, scenario.duration);
  EXPECT_EQ(back.seed, scenario.seed);
}

TEST(WriteScenario, ReadsCornersBackBitForBit) {
  Scenario scenario = Unusual();
  scenario.motion = {};
  scenario.motion.corners = {{0, 1.0 / 3}, {0.1, 1.0 / 3}, {1e3 / 7, -1e-300}};
  scenario.motion.start = -1.0 / 7;
  EXPECT_EQ(ReadBack(scenario).motion, scenario.motion);
}

TEST(WriteScenario, IsAFixedPoint) {
  Scenario limits = test::Table1();
  limits.motion.hold = 0;
  limits.motion.travel_between_joint_limits = true;
  limits.friction.thermal.reset();
  Scenario phases = test::Table1();
  phases.motion = {};
  phases.motion.phases = {{100, test::Table1().motion}, {1.0 / 3, std::nullopt}};
  Scenario ideal_only = test::Table1();
  ideal_only.disturbances.gravity = {5, -1.0 / 3};
  ideal_only.disturbances.ambient_drift = {1, 7200};
  ideal_only.disturbances.load_change = {10, 0.1, 600};
  ideal_only.disturbances.second_heat = Thermal{-1.0 / 3, 60};
  for (const Scenario& scenario : {Unusual(), test::Table1(), limits, phases, ideal_only}) {
    EXPECT_EQ(ReadBack(scenario).disturbances, scenario.disturbances);
    EXPECT_EQ(ReadBack(scenario).motion, scenario.motion);
    EXPECT_EQ(ScenarioToYaml(ReadBack(scenario)), ScenarioToYaml(scenario));
  }
}

TEST(WriteScenario, WithSettingsChangesOnlyWhatTheyName) {
  Scenario expected = Unusual();
  expected.noise.torque = 3;
  EXPECT_EQ(ScenarioToYaml(WithSettings(Unusual(), {{"noise.torque", "3"}})),
            ScenarioToYaml(expected));
}

}  // namespace
}  // namespace warmjoint
