// Columns of a wide file by joint.
#include "models/robot_log/robot_columns.h"

#include <gtest/gtest.h>

#include "models/robot_log/column_pattern.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

using Words = std::vector<std::string>;

RobotColumns Find(const Words& names, const Words& joints, const ColumnTexts& map = {}) {
  return FindRobotColumns(names, joints, map, {"log.csv"});
}

TEST(RobotColumns, FindsNumberedFamiliesAndLeavesTargetsAlone) {
  const RobotColumns found =
      Find({"timestamp", "target_q_0", "target_q_1", "actual_q_0", "actual_q_1", "actual_qd_0",
            "actual_qd_1", "actual_current_0", "actual_current_1", "actual_current_window_0",
            "actual_current_window_1"},
           {"shoulder", "elbow"});
  EXPECT_EQ(found.joints, (Words{"shoulder", "elbow"}));
  EXPECT_EQ(found.maps[1].at("position"), "actual_q_1");
  EXPECT_EQ(found.maps[1].at("torque"), "actual_current_1");
  EXPECT_EQ(found.maps[1].at("time"), "timestamp");
  EXPECT_TRUE(found.torque_is_current);
}

TEST(RobotColumns, CountsFromOneAndReadsBrackets) {
  for (const Words& names :
       {Words{"t", "q1", "q2", "qd1", "qd2", "tau1", "tau2"},
        Words{"t", "q[0]", "q[1]", "tau[0]", "tau[1]"},
        Words{"t", "joint_1_pos", "joint_2_pos", "joint_1_torque", "joint_2_torque"}}) {
    const RobotColumns found = Find(names, {"a", "b"});
    ASSERT_EQ(found.maps.size(), 2U) << names[1];
    EXPECT_FALSE(found.torque_is_current);
    EXPECT_NE(found.maps[0].at("position"), found.maps[1].at("position"));
  }
}

TEST(RobotColumns, GoesByJointNamesInAnyOrder) {
  const RobotColumns found = Find({"time", "elbow_effort", "elbow_position", "shoulder_effort",
                                   "shoulder_position", "wrist_effort"},
                                  {"shoulder", "elbow", "wrist"});
  EXPECT_EQ(found.joints, (Words{"shoulder", "elbow"}));
  EXPECT_EQ(found.maps[0].at("torque"), "shoulder_effort");
}

TEST(RobotColumns, GoesByNamesWithoutTheWordJoint) {
  const Words joints{"shoulder_lift_joint", "wrist_1_joint", "joint-elbow"};
  const Words names{"time",
                    "state.wrist_1.pos",
                    "state.elbow.pos",
                    "state.shoulder_lift.pos",
                    "meas.wrist_1.eff",
                    "meas.elbow.eff",
                    "meas.shoulder_lift.eff"};
  const RobotColumns found = Find(names, joints);
  EXPECT_EQ(found.joints, joints);
  EXPECT_TRUE(found.notices.empty());
  EXPECT_EQ(found.maps[0].at("torque"), "meas.shoulder_lift.eff");
  EXPECT_EQ(found.maps[1].at("position"), "state.wrist_1.pos");
  // patterns, too
  const RobotColumns mapped =
      Find(names, joints, {{"position", "state.{name}.pos"}, {"torque", "meas.{name}.eff"}});
  EXPECT_EQ(mapped.maps[2].at("position"), "state.elbow.pos");
}

TEST(RobotColumns, ShortNamesAreWholeWordsOfOneJoint) {
  // "a" and "b" are in other words, and "lift" of two joints
  EXPECT_EQ(Find({"time", "actual_pos_a", "actual_pos_b", "tau_b", "tau_a"}, {"a_joint", "b_joint"})
                .maps[1]
                .at("position"),
            "actual_pos_b");
  EXPECT_NE(test::RefusalOf([] {
              Find({"time", "forklift_pos", "forklift_torque"}, {"lift_joint"});
            }).find("told by their names"),
            std::string::npos);
  EXPECT_NE(test::RefusalOf([] {
              Find({"time", "lift_pos", "lift_torque"}, {"lift_joint", "joint_lift"});
            }).find("told by their names"),
            std::string::npos);
}

TEST(RobotColumns, TakesTheFirstJointsOfARobotThatHasMore) {
  const RobotColumns found = Find({"t", "q0", "q1", "tau0", "tau1"}, {"a", "b", "finger"});
  EXPECT_EQ(found.joints, (Words{"a", "b"}));
  EXPECT_EQ(found.notices.size(), 1U);
}

TEST(RobotColumns, ExpandsPatterns) {
  const Words joints{"a", "b", "c"};
  EXPECT_EQ(ColumnOfJoint("q[{j}]", joints, 2), "q[2]");
  EXPECT_EQ(ColumnOfJoint("q{1..3}", joints, 2), "q3");
  EXPECT_EQ(ColumnOfJoint("{name}/pos", joints, 1), "b/pos");
  EXPECT_EQ(ColumnOfJoint("{x|y|z}", joints, 0), "x");
  EXPECT_THROW(ColumnOfJoint("{x|y}", joints, 0), BadInput);
  EXPECT_THROW(ColumnOfJoint("q", joints, 0), BadInput);
}

TEST(RobotColumns, RefusesWhatItCannotTell) {
  EXPECT_THROW(Find({"t", "a0", "a1", "tau0", "tau1"}, {"x", "y"}), BadInput);
  EXPECT_THROW(
      Find({"t", "left_q0", "left_q1", "right_q0", "right_q1", "tau0", "tau1"}, {"x", "y"}),
      BadInput);
}

}  // namespace
}  // namespace warmjoint
