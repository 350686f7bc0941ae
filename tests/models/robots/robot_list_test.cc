#include "models/robots/robot_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace warmjoint {
namespace {

using testing::DoubleNear;

using testing::IsSupersetOf;

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

}  // namespace
}  // namespace warmjoint
