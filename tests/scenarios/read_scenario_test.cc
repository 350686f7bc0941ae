#include "scenarios/read_scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>

#include "tests/support/refusal.h"
#include "tests/support/table1.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

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

TEST(ReadScenario, ReadsTheScenarioOfTable1) {
  EXPECT_EQ(ScenarioToYaml(Read(Lines())), ScenarioToYaml(test::Table1()));
}

/// A line (from 1) that reads otherwise; where that is refused, and what the refusal names.
struct WrongLine {
  int number;
  std::string line;
  std::string key;
};

TEST(ReadScenario, RefusesLinesThatCannotBeAtTheirPlace) {
  const std::vector<WrongLine> rows{
      // keys
      {9, "noize: {torque: 0.5}", "'noise'"},
      {7, "  speds: [0.1]", "'speeds'"},
      {10, "sampling: {rat: 1}", "'rate'"},
      // numbers
      {9, "noise: {torque: -0.5}", "noise.torque is '-0.5'"},
      {10, "sampling: {rate: 0}", "sampling.rate is '0'"},
      {11, "duration: 0", "duration is '0'"},
      {11, "duration: 2", "2 samples"},
      {11, "duration: .nan", "duration"},
      {11, "duration: nan", "duration"},
      {8, "  hold: inf", "motion.hold is 'inf'"},
      {12, "seed: 1.5", "seed is '1.5'"},
      // types
      {9, "noise: loud", "noise is 'loud'"},
      {11, "duration: an hour", "duration is 'an hour'"},
      {7, "  speeds: 0.5", "speeds"},
      {4, "  parameters: {viscous: much, coulomb: 15}", "friction.parameters.viscous is 'much'"},
      // motions
      {7, "  speeds: []", "motion.speeds"},
      {7, "  speeds: [0.1, -1]", "motion.speeds.1 is '-1'"},
      {7, "  speeds: {uniform: [1, 0.1]}", "uniform"},
      {7, "  order: shuffled", "speeds, phases"},
      {8, "  order: shuffled", "hold: seconds"},
      {8, "  {hold: 20, travel: [0, 1]}", "YAML"},
      {8, "  travel: [1, 0]", "travel"},
      {8, "  travel: limits", "motion.travel is 'limits'"},
      {8, "  hold: 20\n  order: random", "motion.order is 'random'"},
      {8, "  hold: 20\n  rests: {run: 5}", "'motion.rests.rest'"},
      // sampling
      {10, "sampling: {rate: 20, sensor_rate: 10}", "sampling.rate is '20'"},
      {10, "sampling: {sensor_rate: 250, cutoff: 125}", "cutoff"},
      // friction
      {3, "  law: viscous_columb", "'viscous_coulomb'"},
      {4, "  parameters: {viscous: -5, coulomb: 15}", "viscous is -5"},
      {4, "  parameters: {viscous: {uniform: [-1, 5]}, coulomb: 15}", "viscous is -1"},
      {4, "  parameters: {viscous: {normal: [5, 1]}, coulomb: 15}", "log_uniform"},
      // plants
      {1, "plant: mujoco", "'robot'"},
      {1, "plant: mujoco\nrobot: rotary", "'joint'"},
      {1, "plant: mujco", "'mujoco'"},
      // YAML
      {9, "noise: {torque: 0.5", "YAML"},
      {12, "duration: 5", "'duration'"},
  };
  for (const WrongLine& one : rows) {
    SCOPED_TRACE(one.line);
    auto lines = Lines();
    lines[static_cast<size_t>(one.number) - 1] = one.line;
    test::ExpectNames(test::RefusalOf([&] { Read(lines); }), "table1.yaml", one.key);
  }
  test::ExpectNames(test::RefusalOf([] { Read({}); }), "table1.yaml", "the document is nothing");
}

TEST(ReadScenario, NamesTheLineOfARefusal) {
  for (const int number : {3, 4, 7, 9, 10, 11}) {
    auto lines = Lines();
    std::string& line = lines[static_cast<size_t>(number) - 1];
    line.replace(line.find(':'), 1, "x:");
    EXPECT_THAT(test::RefusalOf([&] { Read(lines); }),
                HasSubstr("table1.yaml:" + std::to_string(number)));
  }
}

TEST(ReadScenario, RefusesSettingsThatCannotBe) {
  // entries that stand for a file's, as `--set` gives them: key, value, what the refusal names
  const std::vector<std::array<std::string, 3>> rows{
      {"noise.torque", "-1", "--set noise.torque=-1: noise.torque is '-1'"},
      {"nois.torque", "1", "'noise'"},
      {"seed.low", "1", "--set seed.low"},
      {"noise.torque", "[1", "--set noise.torque"},
      {"", "1", "empty"},
      {"motion.travel", "[0, 1]", "hold: seconds"},
      {"motion", "{phases: []}", "phases"},
      {"motion", "{phases: [{rest: 0}]}", "motion.phases.0.rest is '0'"},
      {"motion", "{phases: [{speeds: [1], hold: 1}]}", "rest and duration"},
      {"motion", "{phases: [{duration: 5, speeds: [1], travel: [0, 1]}]}", "phases.0.travel"},
      {"motion", "{phases: [{rest: 3}], hold: 5}", "hold"},
      {"motion", "{fourier: {period: 10, harmonics: 2.5, speed: 1}}",
       "motion.fourier.harmonics is '2.5'"},
      {"motion", "{moves: {between: [-1, 1], speed: 1, acceleration: 2e6}}", "lower acceleration"},
      {"motion", "{corners: []}", "speeds, phases"},
      {"motion", "{corners: [[0, 0, 1]]}", "corners"},
      {"motion", "{corners: [[-1, 0]]}", "motion.corners.0.0 is '-1'"},
      {"motion", "{corners: [[0, 0], [0, 1]]}", "corners"},
      {"motion", "{corners: [[0, 0]], speeds: [1], hold: 1}", "speeds, phases"},
      {"disturbances", "{outliers: {fraction: 1, size: 5}}", "fraction"},
      {"disturbances", "{lost_samples: {fraction: 1.5}}", "fraction"},
      {"disturbances", "{outliers: {fraction: 0.1}}", "'disturbances.outliers.size'"},
      {"disturbances", "{coloured_noise: {deviation: -1, correlation_time: 1}}",
       "disturbances.coloured_noise.deviation is '-1'"},
      {"disturbances", "{graviti: {}}", "'gravity'"},
  };
  for (const auto& [key, value, named] : rows) {
    SCOPED_TRACE(key + "=" + value);
    const Settings settings{{key, value}};
    EXPECT_THAT(test::RefusalOf([&] { Read(Lines(), settings); }), HasSubstr(named));
  }
  const auto read = [](const std::string& key, const std::string& value,
                       const std::string& plant = "ideal") {
    return test::RefusalOf([&] {
      Read(Lines(), {{key, value}, {"plant", plant}, {"robot", "rotary"}, {"joint", "hinge"}});
    });
  };
  EXPECT_EQ(read("motion", "{phases: [{duration: 5, speeds: [1], hold: 1}, {rest: 3}]}"),
            "accepted");
  EXPECT_EQ(read("motion", "{corners: [[0, 0], [1, -0.5]], start: 2}"), "accepted");
  EXPECT_EQ(read("disturbances", "{gravity: {sine: 5, cosine: 0}}"), "accepted");
  EXPECT_EQ(read("disturbances", "{outliers: {fraction: 0.1, size: 5}}", "mujoco"), "accepted");
  EXPECT_THAT(read("disturbances", "{gravity: {sine: 5, cosine: 0}}", "mujoco"),
              HasSubstr("disturbances.gravity"));
}

TEST(ReadScenario, AppliesSettings) {
  EXPECT_EQ(Read(Lines(), {{"noise.torque", "2"}}).noise.torque, 2);
  EXPECT_EQ(Read(Lines(), {{"controller.bandwidth", "7"}}).controller.bandwidth, 7);
  EXPECT_EQ(Read(Lines(), {{"motion.speeds", "[1, 2]"}}).motion.speeds.list.size(), 2);
  EXPECT_TRUE(
      Read(Lines(), {{"motion.hold", "null"}, {"motion.travel", "[0, 1]"}}).motion.travel.limits);
}

TEST(ReadScenario, ReadsFilesAndTheFrictionFilesBesideThem) {
  const ScratchDirectory folder;
  std::ofstream(folder.path() / "warm.json")
      << R"({"law": "coulomb", "parameters": {"coulomb": 2}, "gear": 30})";
  std::ofstream(folder.path() / "short.yaml")
      << "friction: warm.json\nmotion: {speeds: [1], hold: 1}\nduration: 10\n";
  const Scenario scenario = ReadScenario((folder.path() / "short.yaml").string());
  EXPECT_EQ(scenario.name, "short");
  EXPECT_EQ(scenario.friction.law, "coulomb");
  EXPECT_EQ(scenario.friction.gear, 30);
  EXPECT_THROW(ReadScenario("absent.yaml"), BadInput);
}

}  // namespace
}  // namespace warmjoint
