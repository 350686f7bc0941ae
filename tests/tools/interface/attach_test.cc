#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/attach.h>
#include <warmjoint/identify.h>

#include "models/foundation/atomic_file.h"
#include "models/robots/robot_folder.h"
#include "tests/tools/cli/recording_file.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/interface/motions.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint::api {
namespace {

using testing::HasSubstr;

std::string FrictionFile(const std::string& robot) {
  return DataFolder() / "models" / "robots" / robot / "friction.json";
}

TEST(Attach, WritesTheModelOfTheCommandInBothForms) {
  const ScratchDirectory scratch;
  const auto theirs = scratch.path() / "theirs.xml", ours = scratch.path() / "ours.xml";
  for (const std::string form : {"actuator", "passive"}) {
    const ProgramAnswer answer =
        RunWarmjoint({"attach", "yumi_like", "--joint", "joint_.*=" + FrictionFile("yumi_like"),
                      "--as", form, "--initial", "settled:0.2", "--armature", "joint_.*=0.125",
                      "--integrator", "implicitfast", "--timestep", "0.0005", "-o", theirs});
    ASSERT_EQ(answer.status, 0) << answer.err;
    AttachSettings settings;
    settings.form = form;
    settings.armatures = {{"joint_.*", 0.125}};
    settings.integrator = "implicitfast";
    settings.timestep = 0.0005;
    const Attached attached = Attach(
        "yumi_like", {ReadJointFriction("joint_.*", FrictionFile("yumi_like"), "settled:0.2")},
        ours, settings);
    EXPECT_EQ(ReadWholeFile(ours), ReadWholeFile(theirs)) << form;
    EXPECT_EQ(attached.joints.size(), 7u);
    for (const std::string& notice : attached.notices) EXPECT_THAT(answer.err, HasSubstr(notice));
  }
}

TEST(Attach, WritesTheSmallModelOfIdentify) {
  const ScratchDirectory scratch;
  const std::string log = scratch.path() / "log.csv";
  const auto theirs = scratch.path() / "theirs.xml", ours = scratch.path() / "ours.xml";
  WriteRecordingFile(log, 480, SeveralSpeeds);
  ASSERT_EQ(RunWarmjoint({"identify", log, "--identifier", "nominal-ls", "--mjcf", theirs}).status,
            0);
  IdentifySettings settings;
  settings.identifier = "nominal-ls";
  const Estimate estimate = Identify(ReadRecording(log), settings);
  WriteMinimalModel(*estimate.friction, JointKind::rotary, ours);
  EXPECT_EQ(ReadWholeFile(ours), ReadWholeFile(theirs));
  EXPECT_EQ(MinimalModel(*estimate.friction), ReadWholeFile(theirs));
}

TEST(Attach, TellsOfAVoidFriction) {
  const ScratchDirectory scratch;
  Estimate estimate;
  estimate.status = Status::inadequate_model;
  estimate.friction = ReadFriction(FrictionFile("pendulum"));
  WriteEstimate(estimate, scratch.path() / "void.json");
  EXPECT_THAT(ReadJointFriction("hinge", scratch.path() / "void.json").warning, HasSubstr("void"));
  EXPECT_EQ(ReadJointFriction("hinge", FrictionFile("pendulum")).warning, "");
  estimate.friction.reset();
  WriteEstimate(estimate, scratch.path() / "none.json");
  EXPECT_THROW(ReadJointFriction("hinge", scratch.path() / "none.json"), BadInput);
}

TEST(Attach, RefusesAndWritesNothing) {
  const ScratchDirectory scratch;
  const auto out = scratch.path() / "out.xml";
  const JointFriction hinge = ReadJointFriction("hinge", FrictionFile("pendulum"));
  const auto refusal = [&](const JointFriction& friction, const AttachSettings& settings = {}) {
    try {
      Attach("pendulum", {friction}, out, settings);
    } catch (const BadInput& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  JointFriction mistyped = hinge;
  mistyped.joint = "hing";
  EXPECT_THAT(refusal(mistyped), HasSubstr("'hinge'"));
  AttachSettings settings;
  settings.form = "pasive";
  EXPECT_THAT(refusal(hinge, settings), HasSubstr("'passive'"));
  settings = {};
  settings.timestep = 0;
  EXPECT_THAT(refusal(hinge, settings), HasSubstr("above 0"));
  settings = {};
  settings.integrator = "euler";
  EXPECT_THAT(refusal(hinge, settings), HasSubstr("'Euler'"));
  settings = {};
  settings.armatures = {{"hinge", -1}};
  EXPECT_THAT(refusal(hinge, settings), HasSubstr("0 or more"));
  settings = {};
  settings.packages = {{"robot", "absent"}};
  EXPECT_THAT(refusal(hinge, settings), HasSubstr("not a folder"));
  EXPECT_THROW(Attach("pendlum", {hinge}, out), BadInput);
  EXPECT_THROW(ReadJointFriction("hinge", FrictionFile("pendulum"), "warm"), BadInput);
  EXPECT_FALSE(std::filesystem::exists(out));
  const auto model = scratch.path() / "model.xml";
  WriteWholeFile(model, MinimalModel(hinge.friction));
  EXPECT_THROW(Attach(model, {hinge}, model), BadInput) << "it would be lost";
}

}  // namespace
}  // namespace warmjoint::api
