#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/simulate.h>

#include <cmath>

#include "models/foundation/atomic_file.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/cli/table_one_yaml.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint::api {
namespace {

using testing::HasSubstr;

void ExpectNear(const std::vector<double>& ours, const std::vector<double>& theirs) {
  ASSERT_EQ(ours.size(), theirs.size());
  for (std::size_t i = 0; i < ours.size(); ++i) {
    // the program masks glibc's forms with fused multiply-adds, this process does not: some last bits
    ASSERT_NEAR(ours[i], theirs[i], 1e-10 * std::max(1.0, std::abs(theirs[i]))) << i;
  }
}

TEST(Simulate, MakesTheFilesOfTheCommand) {
  const ScratchDirectory scratch;
  const std::string yaml = scratch.path() / "little.yaml";
  WriteWholeFile(yaml, TableOneYaml(600));
  const auto theirs = scratch.path() / "theirs", ours = scratch.path() / "ours";
  const ProgramAnswer answer =
      RunWarmjoint({"simulate", yaml, "--seed", "7", "--set", "noise.torque=0.1", "--realization",
                    "2", "-o", theirs});
  ASSERT_EQ(answer.status, 0) << answer.err;

  SimulateSettings settings;
  settings.seed = 7;
  settings.set = {{"noise.torque", "0.1"}};
  settings.realization = 2;
  const Simulation simulation = Simulate(yaml, settings);
  WriteSimulation(simulation, ours);
  EXPECT_EQ(ReadWholeFile(ours / "scenario.yaml"), ReadWholeFile(theirs / "scenario.yaml"));
  const Recording recording = ReadRecording(theirs / "recording.csv");
  ExpectNear(simulation.recording.time, recording.time);
  ExpectNear(simulation.recording.torque, recording.torque);
  EXPECT_EQ(ReadRecording(ours / "recording.csv").torque, simulation.recording.torque);

  const Truth truth = ReadTruth(theirs / "truth.json");
  ExpectNear(simulation.truth.force, truth.force);
  ExpectNear(simulation.truth.energy, truth.energy);
  EXPECT_EQ(simulation.truth.friction.parameters, truth.friction.parameters);
  EXPECT_EQ(simulation.truth.torque_noise, 0.1);
  EXPECT_EQ(truth.plant, "ideal");
}

TEST(Simulate, TellsOfAJointThatDoesNotFollowItsMotion) {
  SimulateSettings settings;
  settings.set = {{"plant", "mujoco"},   {"robot", "rotary"},        {"joint", "hinge"},
                  {"timestep", "0.002"}, {"motion.speeds", "[0.1]"}, {"controller.bandwidth", "5"}};
  EXPECT_THAT(SimulateText(TableOneYaml(60), settings).not_following,
              HasSubstr("controller.bandwidth to 67 rad/s"));
  settings.set.back().second = "67";
  EXPECT_EQ(SimulateText(TableOneYaml(60), settings).not_following, "");
}

TEST(Simulate, TakesATextAndReplaysItsOwn) {
  const Simulation first = SimulateText(TableOneYaml(300));
  const Simulation again = SimulateText(first.scenario);
  EXPECT_EQ(again.recording.torque, first.recording.torque);
  EXPECT_EQ(again.scenario, first.scenario);
}

TEST(Simulate, TellsHowFarItIsAndEndsWhereTheWatchThrows) {
  // a watch is told of runs that take their time: those of the engine
  const std::string yaml = R"(plant: mujoco
robot: pendulum
joint: hinge
friction: {law: coulomb, parameters: {coulomb: 0.1}}
motion: {speeds: [0.5], hold: 2, order: alternating}
duration: 20
)";
  SimulateSettings settings;
  settings.watch = [](double share) {
    EXPECT_GE(share, 0);
    throw std::runtime_error("enough");
  };
  EXPECT_THROW(SimulateText(yaml, settings), std::runtime_error);
}

TEST(Simulate, RefusesWithThePlace) {
  try {
    SimulateText(TableOneYaml(300) + "speds: 1\n", {}, "mine");
    ADD_FAILURE() << "nothing was refused";
  } catch (const BadInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("mine:"));
    EXPECT_THAT(error.what(), HasSubstr("speds"));
  }
  EXPECT_THROW(Simulate("absent.yaml"), BadInput);
  EXPECT_THROW(ReadTruth("absent.json"), BadInput);
  const ScratchDirectory scratch;
  const Simulation simulation = SimulateText(TableOneYaml(60));
  EXPECT_THROW(WriteSimulation(simulation, scratch.path() / "out", "xls"), BadInput);
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "out"));
  WriteWholeFile(scratch.path() / "mine.txt", "mine");
  EXPECT_THROW(WriteSimulation(simulation, scratch.path()), BadInput) << "it holds other files";
}

}  // namespace
}  // namespace warmjoint::api
