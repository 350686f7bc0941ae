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

using ::testing::DoubleNear;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::ThrowsMessage;

const RobotInfo& Find(const std::vector<RobotInfo>& robots, const std::string& name) {
  return *std::find_if(robots.begin(), robots.end(),
                       [&](const RobotInfo& robot) { return robot.name == name; });
}

TEST(Robots, AreTheFoldersOfModelsRobots) {
  EXPECT_THAT(RobotNames(),
              IsSupersetOf({"irb140_like", "linear_axis", "pendulum", "rotary", "yumi_like"}));
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

TEST(RobotFolder, FindsARobotByItsNameAndTakesAPathAsItIs) {
  const std::filesystem::path file = FindRobot("rotary", "test");
  EXPECT_TRUE(std::filesystem::is_regular_file(file)) << file;
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

TEST(ReadUrdf, RefusesWhatIsNoRobotByItsFile) {
  const std::string no_limits =
      "<robot name='r'><link name='a'/><link name='b'/>"
      "<joint name='elbow' type='revolute'><parent link='a'/><child link='b'/></joint></robot>";
  // depth that would end its parser
  std::string deep = "<robot name='r'>\n";
  for (int i = 0; i < 200'000; ++i) deep += "<a>";
  for (const auto& [text, named] :
       {std::pair(no_limits, "elbow"),
        std::pair(std::string("joints, links\n"), "cannot be used as URDF"),
        std::pair(deep, ":2: nests deeper than 500 elements")}) {
    const TemporaryFile file("robot.urdf", text);
    test::ExpectNames(test::RefusalOf([&] { ReadUrdf(file.path()); }), file.path(), named);
  }
}

}  // namespace
}  // namespace warmjoint
