#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "models/foundation/bad_input.h"
#include "models/robots/robot_folder.h"
#include "tests/models/recording/temporary_file.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::DoubleNear;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::ThrowsMessage;

std::vector<std::string> Names(const std::vector<RobotInfo>& robots) {
  std::vector<std::string> names;
  for (const RobotInfo& robot : robots) names.push_back(robot.name);
  return names;
}

const RobotInfo& Find(const std::vector<RobotInfo>& robots, const std::string& name) {
  return *std::find_if(robots.begin(), robots.end(),
                       [&](const RobotInfo& robot) { return robot.name == name; });
}

TEST(Robots, AreTheFoldersOfModelsRobots) {
  EXPECT_THAT(Names(Robots()),
              IsSupersetOf({"irb140_like", "linear_axis", "pendulum", "rotary", "yumi_like"}));
}

TEST(Robots, NameTheJointsFromTheBaseOutwards) {
  const std::vector<RobotInfo> robots = Robots();
  std::vector<std::string> joints;
  for (const RobotJoint& joint : Find(robots, "yumi_like").joints) joints.push_back(joint.name);
  EXPECT_THAT(joints, testing::ElementsAre("joint_1", "joint_2", "joint_7", "joint_3", "joint_4",
                                           "joint_5", "joint_6"));
}

TEST(Robots, TellLinearJointsFromRotaryOnes) {
  const std::vector<RobotInfo> robots = Robots();
  EXPECT_EQ(Find(robots, "linear_axis").joints.at(0).kind, JointKind::linear);
  EXPECT_EQ(Find(robots, "pendulum").joints.at(0).kind, JointKind::rotary);
}

TEST(Robots, HoldTheFrictionOfOneNamedJoint) {
  const std::vector<RobotInfo> robots = Robots();
  EXPECT_EQ(Find(robots, "yumi_like").friction_joint, "joint_4");
  EXPECT_EQ(Find(robots, "yumi_like").friction.parameters.at("viscous"), 0.0527);
  // 20.3935 N with an offset of -3.1648 N, as published
  const auto& levels = Find(robots, "linear_axis").friction.parameters;
  EXPECT_THAT(levels.at("coulomb_positive") + levels.at("coulomb_negative"),
              DoubleNear(2 * 20.3935, 1e-12));
  EXPECT_THAT(levels.at("coulomb_positive") - levels.at("coulomb_negative"),
              DoubleNear(2 * -3.1648, 1e-12));
}

TEST(RobotFolder, ListsAndFindsTheRobotsOfTheProject) {
  EXPECT_THAT(RobotNames(), Contains("rotary"));
  for (const std::string& name : RobotNames()) {
    EXPECT_TRUE(std::filesystem::is_regular_file(FindRobot(name, "test"))) << name;
  }
}

TEST(RobotFolder, TakesAPathAsItIs) {
  const std::filesystem::path file = FindRobot("rotary", "test");
  EXPECT_EQ(FindRobot(file.string(), "test"), file);
}

TEST(RobotFolder, RefusesWhatIsNoRobot) {
  test::ExpectRefused(
      {{"rotari", "my.yaml: ", "'rotary'"}, {"no/such.xml", "my.yaml: ", "no/such.xml"}},
      [](const std::string& name) { FindRobot(name, "my.yaml"); });
}

TEST(RobotFolder, RefusesADataFolderWithoutRobots) {
  setenv("WARMJOINT_DATA", "/nowhere", 1);
  EXPECT_THAT([] { DataFolder(); },
              ThrowsMessage<BadInput>(HasSubstr("was not found in /nowhere; set WARMJOINT_DATA")));
  unsetenv("WARMJOINT_DATA");
}

TEST(ReadUrdf, GivesLinksAndJoints) {
  const TemporaryFile file("robot.urdf",
                           "<robot name='r'><link name='a'/><link name='b'/>"
                           "<joint name='j' type='continuous'><parent link='a'/>"
                           "<child link='b'/></joint></robot>");
  EXPECT_EQ(ReadUrdf(file.path())->getJoint("j")->child_link_name, "b");
}

TEST(ReadUrdf, NamesFileAndJointOfAJointWithoutLimits) {
  const TemporaryFile file("robot.urdf",
                           "<robot name='r'><link name='a'/><link name='b'/>"
                           "<joint name='elbow' type='revolute'><parent link='a'/>"
                           "<child link='b'/></joint></robot>");
  EXPECT_THAT([&] { ReadUrdf(file.path()); },
              ThrowsMessage<BadInput>(AllOf(HasSubstr(file.path()), HasSubstr("elbow"))));
}

TEST(ReadUrdf, RefusesWhatIsNoXml) {
  const TemporaryFile file("robot.urdf", "joints, links\n");
  EXPECT_THAT([&] { ReadUrdf(file.path()); },
              ThrowsMessage<BadInput>(HasSubstr("cannot be used as URDF")));
}

TEST(ReadUrdf, RefusesDepthThatWouldEndItsParser) {
  std::string deep = "<robot name='r'>\n";
  for (int i = 0; i < 200'000; ++i) deep += "<a>";
  const TemporaryFile file("robot.urdf", deep);
  EXPECT_THAT([&] { ReadUrdf(file.path()); },
              ThrowsMessage<BadInput>(HasSubstr(":2: nests deeper than 500 elements")));
}

}  // namespace
}  // namespace warmjoint
