#include "scenarios/read_scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/table1.h"

namespace warmjoint {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A scenario file of twelve lines; each test changes one of them.
std::vector<std::string> Lines() {
  return {"plant: ideal",
          "friction:",
          "  law: viscous_coulomb",
          "  parameters: {viscous: 5, coulomb: 15}",
          "  thermal: {thermal_gain: -3, thermal_time_constant: 600}",
          "motion:",
          "  speeds: {uniform: [0.1, 1]}",
          "  hold: 20",
          "noise: {torque: 0.5}",
          "sampling: {rate: 1}",
          "duration: 3600",
          "seed: 1"};
}

Scenario Read(const std::vector<std::string>& lines, const Settings& settings = {}) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return ParseScenario(text, "table1.yaml", settings);
}

std::string Refusal(const std::vector<std::string>& lines, const Settings& settings = {}) {
  try {
    Read(lines, settings);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "(accepted)";
}

/// What is said when line `number` (from 1) reads `line` instead.
std::string RefusalOf(int number, const std::string& line) {
  auto lines = Lines();
  lines[static_cast<size_t>(number) - 1] = line;
  return Refusal(lines);
}

TEST(ReadScenario, ReadsTheScenarioOfTable1) {
  EXPECT_EQ(ScenarioToYaml(Read(Lines())), ScenarioToYaml(test::Table1()));
}

TEST(ReadScenario, NamesPlaceAndNearestKeyOfAnUnknownOne) {
  EXPECT_THAT(
      RefusalOf(9, "noize: {torque: 0.5}"),
      AllOf(HasSubstr("table1.yaml:9: unknown key 'noize'"), HasSubstr("did you mean 'noise'?")));
  EXPECT_THAT(RefusalOf(7, "  speds: [0.1]"),
              AllOf(HasSubstr("table1.yaml:7"), HasSubstr("did you mean 'speeds'?")));
  EXPECT_THAT(RefusalOf(10, "sampling: {rat: 1}"), HasSubstr("did you mean 'rate'?"));
}

TEST(ReadScenario, RefusesImpossibleNumbersWithValueAndBound) {
  EXPECT_THAT(
      RefusalOf(9, "noise: {torque: -0.5}"),
      HasSubstr("table1.yaml:9: noise.torque is '-0.5'; it must be a number of at least 0"));
  EXPECT_THAT(RefusalOf(10, "sampling: {rate: 0}"),
              HasSubstr("sampling.rate is '0'; it must be a number above 0"));
  EXPECT_THAT(RefusalOf(11, "duration: 0"), HasSubstr("table1.yaml:11: duration is '0'"));
  EXPECT_THAT(RefusalOf(11, "duration: 2"), HasSubstr("make 2 samples"));
  EXPECT_THAT(RefusalOf(11, "duration: .nan"), HasSubstr("a number above 0"));
  EXPECT_THAT(RefusalOf(11, "duration: nan"), HasSubstr("a number above 0"));
  EXPECT_THAT(RefusalOf(8, "  hold: inf"), HasSubstr("motion.hold is 'inf'"));
  EXPECT_THAT(RefusalOf(12, "seed: 1.5"), HasSubstr("seed is '1.5'"));
}

TEST(ReadScenario, RefusesWrongTypes) {
  EXPECT_THAT(RefusalOf(9, "noise: loud"), HasSubstr("noise is 'loud'; it must be a map"));
  EXPECT_THAT(RefusalOf(11, "duration: an hour"), HasSubstr("duration is 'an hour'"));
  EXPECT_THAT(RefusalOf(7, "  speeds: 0.5"), HasSubstr("a list of speeds"));
  EXPECT_THAT(RefusalOf(4, "  parameters: {viscous: much, coulomb: 15}"),
              HasSubstr("table1.yaml:4: friction.parameters.viscous is 'much'"));
}

TEST(ReadScenario, RefusesMotionsThatCannotBe) {
  EXPECT_THAT(RefusalOf(7, "  speeds: []"), HasSubstr("table1.yaml:7: motion.speeds is a list"));
  EXPECT_THAT(RefusalOf(7, "  speeds: [0.1, -1]"), HasSubstr("motion.speeds.1 is '-1'"));
  EXPECT_THAT(RefusalOf(7, "  speeds: {uniform: [1, 0.1]}"),
              HasSubstr("the lower end must be below the upper"));
  EXPECT_THAT(RefusalOf(7, "  order: shuffled"), HasSubstr("one of speeds, phases"));
  EXPECT_THAT(RefusalOf(8, "  order: shuffled"), HasSubstr("one of hold: seconds, and travel"));
  EXPECT_THAT(RefusalOf(8, "  {hold: 20, travel: [0, 1]}"), HasSubstr("is not YAML"));
  EXPECT_THAT(RefusalOf(8, "  travel: [1, 0]"), HasSubstr("the lower end must be below the upper"));
  EXPECT_THAT(RefusalOf(8, "  travel: limits"), HasSubstr("motion.travel is 'limits'"));
  EXPECT_THAT(Refusal(Lines(), {{"motion.travel", "[0, 1]"}}),
              HasSubstr("one of hold: seconds, and travel"));
  EXPECT_THAT(RefusalOf(8, "  hold: 20\n  order: random"), HasSubstr("motion.order is 'random'"));
  EXPECT_THAT(RefusalOf(8, "  hold: 20\n  rests: {run: 5}"),
              HasSubstr("'motion.rests.rest' is missing"));
}

TEST(ReadScenario, RefusesPhasesThatCannotBe) {
  const auto refusal = [](const std::string& phases) {
    return Refusal(Lines(), {{"motion", "{phases: " + phases + "}"}});
  };
  EXPECT_EQ(refusal("[{duration: 5, speeds: [1], hold: 1}, {rest: 3}]"), "(accepted)");
  EXPECT_THAT(refusal("[]"), HasSubstr("one of speeds, phases"));
  EXPECT_THAT(refusal("[{rest: 0}]"), HasSubstr("motion.phases.0.rest is '0'"));
  EXPECT_THAT(refusal("[{speeds: [1], hold: 1}]"), HasSubstr("one of rest and duration"));
  EXPECT_THAT(refusal("[{duration: 5, speeds: [1], travel: [0, 1]}]"),
              HasSubstr("unknown key 'motion.phases.0.travel'"));
  EXPECT_THAT(refusal("[{rest: 3}], hold: 5"),
              HasSubstr("hold, travel and rests stand beside speeds alone"));
}

TEST(ReadScenario, RefusesCornersThatCannotBe) {
  const auto refusal = [](const std::string& motion) {
    return Refusal(Lines(), {{"motion", "{corners: " + motion + "}"}});
  };
  EXPECT_EQ(refusal("[[0, 0], [1, -0.5]], start: 2"), "(accepted)");
  EXPECT_THAT(refusal("[]"), HasSubstr("one of speeds, phases"));
  EXPECT_THAT(refusal("[[0, 0, 1]]"), HasSubstr("[time, velocity]"));
  EXPECT_THAT(refusal("[[-1, 0]]"), HasSubstr("motion.corners.0.0 is '-1'"));
  EXPECT_THAT(refusal("[[0, 0], [0, 1]]"), HasSubstr("whose times ascend"));
  EXPECT_THAT(refusal("[[0, 0]], speeds: [1], hold: 1"), HasSubstr("one of speeds, phases"));
}

TEST(ReadScenario, RefusesSamplingThatCannotBe) {
  EXPECT_THAT(RefusalOf(10, "sampling: {rate: 20, sensor_rate: 10}"),
              HasSubstr("table1.yaml:10: sampling.rate is '20'; it must be at most sensor_rate"));
  EXPECT_THAT(RefusalOf(10, "sampling: {sensor_rate: 250, cutoff: 125}"),
              HasSubstr("below half the sensor_rate"));
}

TEST(ReadScenario, RefusesDisturbancesThatCannotBe) {
  const auto refusal = [](const std::string& disturbances, const std::string& plant = "ideal") {
    return Refusal(Lines(), {{"disturbances", disturbances},
                             {"plant", plant},
                             {"robot", "rotary"},
                             {"joint", "hinge"}});
  };
  EXPECT_EQ(refusal("{gravity: {sine: 5, cosine: 0}}"), "(accepted)");
  EXPECT_THAT(refusal("{gravity: {sine: 5, cosine: 0}}", "mujoco"),
              HasSubstr("disturbances.gravity is known to the ideal plant alone"));
  EXPECT_EQ(refusal("{outliers: {fraction: 0.1, size: 5}}", "mujoco"), "(accepted)");
  EXPECT_THAT(refusal("{outliers: {fraction: 1, size: 5}}"), HasSubstr("below 1"));
  EXPECT_THAT(refusal("{lost_samples: {fraction: 1.5}}"), HasSubstr("below 1"));
  EXPECT_THAT(refusal("{outliers: {fraction: 0.1}}"),
              HasSubstr("'disturbances.outliers.size' is missing"));
  EXPECT_THAT(refusal("{coloured_noise: {deviation: -1, correlation_time: 1}}"),
              HasSubstr("disturbances.coloured_noise.deviation is '-1'"));
  EXPECT_THAT(refusal("{graviti: {}}"), HasSubstr("did you mean 'gravity'?"));
}

TEST(ReadScenario, RefusesFrictionThatCannotBe) {
  EXPECT_THAT(RefusalOf(3, "  law: viscous_columb"),
              AllOf(HasSubstr("table1.yaml:3"), HasSubstr("did you mean 'viscous_coulomb'?")));
  EXPECT_THAT(RefusalOf(4, "  parameters: {viscous: -5, coulomb: 15}"), HasSubstr("viscous is -5"));
  EXPECT_THAT(RefusalOf(4, "  parameters: {viscous: {uniform: [-1, 5]}, coulomb: 15}"),
              HasSubstr("viscous is -1"));
  EXPECT_THAT(RefusalOf(4, "  parameters: {viscous: {normal: [5, 1]}, coulomb: 15}"),
              HasSubstr("uniform or log_uniform"));
}

TEST(ReadScenario, TheEngineNeedsRobotAndJoint) {
  EXPECT_THAT(RefusalOf(1, "plant: mujoco"), HasSubstr("'robot' is missing"));
  EXPECT_THAT(RefusalOf(1, "plant: mujoco\nrobot: rotary"), HasSubstr("'joint' is missing"));
  EXPECT_THAT(RefusalOf(1, "plant: mujco"), HasSubstr("did you mean 'mujoco'?"));
}

TEST(ReadScenario, RefusesWhatIsNoYamlWithItsLine) {
  EXPECT_THAT(RefusalOf(9, "noise: {torque: 0.5"), HasSubstr("is not YAML"));
  EXPECT_THAT(Refusal({}), HasSubstr("the document is nothing; it must be a map"));
  EXPECT_THAT(RefusalOf(12, "duration: 5"), HasSubstr("the key 'duration' stands twice"));
}

TEST(ReadScenario, AppliesSettingsAndNamesThemInRefusals) {
  EXPECT_EQ(Read(Lines(), {{"noise.torque", "2"}}).noise.torque, 2);
  EXPECT_EQ(Read(Lines(), {{"controller.bandwidth", "7"}}).controller.bandwidth, 7);
  EXPECT_EQ(Read(Lines(), {{"motion.speeds", "[1, 2]"}}).motion.speed_list.size(), 2);
  EXPECT_TRUE(Read(Lines(), {{"motion.hold", "null"}, {"motion.travel", "[0, 1]"}}).motion.travel);

  EXPECT_THAT(Refusal(Lines(), {{"noise.torque", "-1"}}),
              HasSubstr("--set noise.torque=-1: noise.torque is '-1'"));
  EXPECT_THAT(Refusal(Lines(), {{"nois.torque", "1"}}),
              AllOf(HasSubstr("--set nois.torque=1"), HasSubstr("did you mean 'noise'?")));
  EXPECT_THAT(Refusal(Lines(), {{"seed.low", "1"}}), HasSubstr("below a value that is no map"));
  EXPECT_THAT(Refusal(Lines(), {{"noise.torque", "[1"}}), HasSubstr("is not YAML"));
  EXPECT_THAT(Refusal(Lines(), {{"", "1"}}), HasSubstr("empty part"));
}

TEST(ReadScenario, ReadsFilesAndTheFrictionFilesBesideThem) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "read_scenario";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "warm.json")
      << R"({"law": "coulomb", "parameters": {"coulomb": 2}, "gear": 30})";
  std::ofstream(folder / "short.yaml")
      << "friction: warm.json\nmotion: {speeds: [1], hold: 1}\nduration: 10\n";
  const Scenario scenario = ReadScenario((folder / "short.yaml").string());
  EXPECT_EQ(scenario.name, "short");
  EXPECT_EQ(scenario.friction.law, "coulomb");
  EXPECT_EQ(scenario.friction.gear, 30);
  std::filesystem::remove_all(folder);

  EXPECT_THROW(ReadScenario("absent.yaml"), BadInput);
}

}  // namespace
}  // namespace warmjoint
