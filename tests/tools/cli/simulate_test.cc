#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/simulation.h>

#include "models/foundation/atomic_file.h"
#include "scenarios/read_scenario.h"
#include "tests/tools/cli/in_a_folder.h"
#include "tests/tools/cli/little_files.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

/// Ten minutes of Table I.
class Simulate : public InAFolder {
 protected:
  Simulate() { WriteWholeFile(at("scenario.yaml"), TableOneYaml(600) + "seed: 1\n"); }
  ProgramAnswer Into(const std::string& name, const std::vector<std::string>& more = {}) const {
    return Program(With({"simulate", "scenario.yaml", "-o", name}, more));
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

TEST_F(Simulate, ReplacesAnOlderRecordingButNothingElse) {
  ASSERT_EQ(Into("out").status, 0);
  ASSERT_EQ(Into("out", {"--format", "h5"}).status, 0);
  EXPECT_FALSE(std::filesystem::exists(at("out/recording.csv")));
  EXPECT_EQ(Json({"check", "out/recording.h5"}).at("sampling").at("samples"), 600);

  WriteWholeFile(at("out/notes.txt"), "mine");
  EXPECT_THAT(Refusal({"simulate", "scenario.yaml", "-o", "out"}),
              HasSubstr("holds 'notes.txt', which would be lost"));
  EXPECT_TRUE(std::filesystem::exists(at("out/recording.h5")));
}

TEST_F(Simulate, NoticesAJointThatDoesNotFollowItsMotion) {
  const std::vector<std::string> engine{"--set", "plant=mujoco",   "--set", "robot=rotary",
                                        "--set", "joint=hinge",    "--set", "duration=60",
                                        "--set", "timestep=0.002", "--set", "motion.speeds=[0.1]"};
  const auto with = [&](const std::string& name, const std::string& bandwidth) {
    std::vector<std::string> more;
    if (!bandwidth.empty()) more = {"--set", "controller.bandwidth=" + bandwidth};
    const ProgramAnswer answer = Into(name, With(engine, more));
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
