#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/simulation.h>

#include <fstream>

#include "models/foundation/atomic_file.h"
#include "scenarios/read_scenario.h"
#include "tests/tools/cli/in_a_folder.h"
#include "tests/tools/cli/little_files.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

/// Ten minutes of Table I, ten lines long.
const std::string kScenario = TableOneYaml(600) + "seed: 1\n";

class Simulate : public InAFolder {
 protected:
  Simulate() { WriteWholeFile(at("scenario.yaml"), kScenario); }
  ProgramAnswer Into(const std::string& name, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command{"simulate", "scenario.yaml", "-o", name};
    command.insert(command.end(), more.begin(), more.end());
    return Program(command);
  }

  /// A refusal with this message that leaves nothing but the scenario.
  void ExpectRefusal(const std::vector<std::string>& more, const std::string& message) const {
    const ProgramAnswer answer = Into("out", more);
    EXPECT_EQ(answer.status, 2) << message;
    EXPECT_THAT(answer.err, HasSubstr(message));
    for (const auto& entry : std::filesystem::directory_iterator(scratch_.path())) {
      EXPECT_EQ(entry.path().filename(), "scenario.yaml") << "left behind";
    }
  }
};

TEST_F(Simulate, WritesRecordingTruthAndScenario) {
  ASSERT_EQ(Into("out").status, 0);
  EXPECT_EQ(ReadTruth(at("out/truth.json")).force.size(), 600);
  // what a reader looks for stands before the lines of 600 numbers
  EXPECT_LT(File("out/truth.json").find("torque_noise"), 1000u);
  EXPECT_THAT(File("out/recording.csv"), testing::StartsWith("time,position,velocity,torque"));

  // the written scenario makes the same recording
  Call({"simulate", "out/scenario.yaml", "-o", "again"});
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
  EXPECT_EQ(ReadTruth(at("quiet/truth.json")).torque_noise, 0.25);
}

TEST_F(Simulate, WritesHdf5ThatIdentifyReads) {
  ASSERT_EQ(Into("out", {"--format", "h5"}).status, 0);
  // it is a joint that warms up
  EXPECT_THAT(
      Program({"identify", "out/recording.h5", "--identifier", "nominal-ls", "--holdout", "0"}).out,
      HasSubstr("Try --identifier energy-ml"));
}

TEST_F(Simulate, ReplacesAnOlderRecordingButNothingElse) {
  ASSERT_EQ(Into("out").status, 0);
  ASSERT_EQ(Into("out", {"--format", "h5"}).status, 0);
  EXPECT_FALSE(std::filesystem::exists(at("out/recording.csv")));

  std::ofstream(at("out/notes.txt")) << "mine";
  const ProgramAnswer answer = Into("out");
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.err, HasSubstr("holds 'notes.txt', which would be lost"));
  EXPECT_TRUE(std::filesystem::exists(at("out/recording.h5")));
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
  WriteWholeFile(at("scenario.yaml"), kScenario + "speeed: 3\n");
  ExpectRefusal({}, "scenario.yaml:11: ");
}

TEST_F(Simulate, CarriesARecordingOutAgain) {
  WriteRecordingFile(at("log.csv"), 480);
  WriteWholeFile(at("again.yaml"),
                 "plant: mujoco\nrobot: rotary\njoint: hinge\n"
                 "friction: {law: viscous_coulomb, parameters: {viscous: 5, coulomb: 15}}\n"
                 "sampling: {rate: 10, sensor_rate: 100}\n");
  Call({"simulate", "again.yaml", "--motion", "log.csv", "-o", "again"});
  // what was done can be done again without the recording
  const Scenario written = ReadScenario(at("again/scenario.yaml"));
  EXPECT_GT(written.motion.corners.size(), 30u);
  EXPECT_EQ(written.duration, 479);
}

}  // namespace
}  // namespace warmjoint
