#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/simulation.h>

#include <fstream>

#include "models/foundation/atomic_file.h"
#include "scenarios/read_scenario.h"
#include "tests/tools/cli/recording_file.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/cli/table_one_yaml.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

/// Ten minutes of Table I, ten lines long.
const std::string kScenario = TableOneYaml(600) + "seed: 1\n";

class Simulate : public testing::Test {
 protected:
  void SetUp() override { WriteWholeFile(scenario_, kScenario); }

  ProgramAnswer Into(const std::string& name, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command{"simulate", scenario_, "-o", scratch_.path() / name};
    command.insert(command.end(), more.begin(), more.end());
    return RunWarmjoint(command);
  }

  std::string File(const std::string& name) const { return ReadWholeFile(scratch_.path() / name); }

  /// A refusal with this message that leaves nothing but the scenario.
  void ExpectRefusal(const std::vector<std::string>& more, const std::string& message) const {
    const ProgramAnswer answer = Into("out", more);
    EXPECT_EQ(answer.status, 2) << message;
    EXPECT_THAT(answer.err, HasSubstr(message));
    for (const auto& entry : std::filesystem::directory_iterator(scratch_.path())) {
      EXPECT_EQ(entry.path().filename(), "scenario.yaml") << "left behind";
    }
  }

  ScratchDirectory scratch_;
  std::string scenario_ = scratch_.path() / "scenario.yaml";
};

TEST_F(Simulate, WritesRecordingTruthAndScenario) {
  ASSERT_EQ(Into("out").status, 0);
  EXPECT_EQ(ReadTruth(scratch_.path() / "out/truth.json").force.size(), 600);
  // what a reader looks for stands before the lines of 600 numbers
  EXPECT_LT(File("out/truth.json").find("torque_noise"), 1000u);
  EXPECT_THAT(File("out/recording.csv"), testing::StartsWith("time,position,velocity,torque"));

  // the written scenario makes the same recording
  ASSERT_EQ(RunWarmjoint({"simulate", scratch_.path() / "out/scenario.yaml", "-o",
                          scratch_.path() / "again"})
                .status,
            0);
  EXPECT_EQ(File("again/recording.csv"), File("out/recording.csv"));
  EXPECT_EQ(File("again/truth.json"), File("out/truth.json"));
}

TEST_F(Simulate, SeedRealizationAndSettingsChangeTheRecording) {
  ASSERT_EQ(Into("out").status, 0);
  ASSERT_EQ(Into("seed", {"--seed", "2"}).status, 0);
  ASSERT_EQ(Into("realization", {"--realization", "17"}).status, 0);
  ASSERT_EQ(Into("quiet", {"--set", "noise.torque=0.25"}).status, 0);
  for (const char* other : {"seed", "realization", "quiet"}) {
    EXPECT_NE(File(std::string(other) + "/recording.csv"), File("out/recording.csv")) << other;
  }
  EXPECT_EQ(ReadTruth(scratch_.path() / "quiet/truth.json").torque_noise, 0.25);
}

TEST_F(Simulate, WritesHdf5ThatIdentifyReads) {
  ASSERT_EQ(Into("out", {"--format", "h5"}).status, 0);
  // it is a joint that warms up
  EXPECT_THAT(RunWarmjoint({"identify", scratch_.path() / "out/recording.h5", "--identifier",
                            "nominal-ls", "--holdout", "0"})
                  .out,
              HasSubstr("Try --identifier energy-ml"));
}

TEST_F(Simulate, ReplacesAnOlderRecordingButNothingElse) {
  ASSERT_EQ(Into("out").status, 0);
  ASSERT_EQ(Into("out", {"--format", "h5"}).status, 0);
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "out/recording.csv"));

  std::ofstream(scratch_.path() / "out/notes.txt") << "mine";
  const ProgramAnswer answer = Into("out");
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.err, HasSubstr("holds 'notes.txt', which would be lost"));
  EXPECT_TRUE(std::filesystem::exists(scratch_.path() / "out/recording.h5"));
}

TEST_F(Simulate, NoticesAJointThatDoesNotFollowItsMotion) {
  const std::vector<std::string> engine{"--set", "plant=mujoco",   "--set", "robot=rotary",
                                        "--set", "joint=hinge",    "--set", "duration=60",
                                        "--set", "timestep=0.002", "--set", "motion.speeds=[0.1]"};
  const auto with = [&](const std::string& name, const std::string& bandwidth) {
    std::vector<std::string> more = engine;
    if (!bandwidth.empty()) {
      more.insert(more.end(), {"--set", "controller.bandwidth=" + bandwidth});
    }
    const ProgramAnswer answer = Into(name, more);
    EXPECT_EQ(answer.status, 0) << answer.err;
    return answer.err;
  };
  // (2 * 15 / 0.1 + 4.6 * 5) / 0.895 / 5.4 = 66.8 rad/s
  EXPECT_THAT(with("slow", "5"), HasSubstr("set controller.bandwidth to 67 rad/s"));
  EXPECT_EQ(with("cured", "67"), "");
  EXPECT_EQ(with("chosen", ""), "");
  EXPECT_EQ(with("zero", "0"), "");
  EXPECT_EQ(File("zero/recording.csv"), File("chosen/recording.csv"));
}

TEST_F(Simulate, RefusesWhatCannotBeAndLeavesNothingBehind) {
  ExpectRefusal({"--set", "noise.torqu=1"}, "torque");
  ExpectRefusal({"--set", "noise.torque=-1"}, "-1");
  ExpectRefusal({"--set", "noise"}, "not of the form key=value");
  ExpectRefusal({"--set", "plant=mujoco", "--set", "robot=pendulum", "--set", "joint=elbow"},
                "elbow");
  ExpectRefusal({"--set", "friction.parameters.viscous=fast"}, "fast");
  WriteWholeFile(scenario_, kScenario + "speeed: 3\n");
  ExpectRefusal({}, "scenario.yaml:11: ");
}

TEST(SimulateMotion, CarriesARecordingOutAgain) {
  const ScratchDirectory scratch;
  const std::string log = scratch.path() / "log.csv", scenario = scratch.path() / "again.yaml";
  WriteRecordingFile(log, 480,
                     [](int i) { return (i / 30 % 2 ? -1 : 1) * 0.2 * (1 + i / 60 % 4); });
  WriteWholeFile(scenario,
                 "plant: mujoco\nrobot: rotary\njoint: hinge\n"
                 "friction: {law: viscous_coulomb, parameters: {viscous: 5, coulomb: 15}}\n"
                 "sampling: {rate: 10, sensor_rate: 100}\n");
  const std::string folder = scratch.path() / "again";
  const ProgramAnswer answer = RunWarmjoint({"simulate", scenario, "--motion", log, "-o", folder});
  ASSERT_EQ(answer.status, 0) << answer.err;

  // what was done can be done again without the recording
  const Scenario written = ReadScenario(folder + "/scenario.yaml");
  EXPECT_GT(written.motion.corners.size(), 30u);
  EXPECT_EQ(written.duration, 479);
}

}  // namespace
}  // namespace warmjoint
