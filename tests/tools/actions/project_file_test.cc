#include "tools/actions/project_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/foundation/bad_input.h"
#include "models/foundation/serialize.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

TEST(ProjectFile, HoldsTheOptionsThatDescribeALog) {
  const Project project = ParseProject(
      "map: {time: t_s, velocity: }\nunit: {position: deg}\nscale: {torque: -1}\nwrap: 360\n"
      "joint: linear\ngear: 50\ntrim: 0.2\nshortest_hold: 1\n",
      "warmjoint.yaml");
  EXPECT_THAT(project.map, ElementsAre(Pair("time", "t_s"), Pair("velocity", "")));
  EXPECT_THAT(project.unit, ElementsAre(Pair("position", "deg")));
  EXPECT_THAT(project.scale, ElementsAre(Pair("torque", -1)));
  EXPECT_EQ(project.wrap, 360);
  EXPECT_EQ(project.joint, JointKind::linear);
  EXPECT_EQ(project.gear, 50);
  EXPECT_EQ(project.trim, 0.2);
  EXPECT_EQ(project.shortest_hold, 1);
  EXPECT_EQ(WriteFields(project).size(), 8u);
  EXPECT_EQ(WriteFields(ParseProject("gear: 2\n", "")), Tree({{"gear", 2.0}}));
}

TEST(ProjectFile, RefusesWhatItDoesNotKnowAndWhatRuns) {
  const std::string first = "warmjoint.yaml:1", second = "warmjoint.yaml:2",
                    file = "warmjoint.yaml";
  test::ExpectRefused(
      {{"gear: 2\nidentifier: \"mine=sh {recording} {estimate}\"\n", second, "'identifier'"},
       {"command: touch P\n", first, "'command'"},
       {"set:\n  command: x\n", file, "'set'"},
       {"joint: rotary\ngaer: 50\n", second, "'gear'"},
       {"map: {torqe: f}\n", first, "'torque'"},
       {"unit: {position: degree}\n", first, "position"},
       {"joint: prismatic\n", first, "joint is 'prismatic'"},
       {"gear: 0\n", first, "gear"},
       {"gear: .inf\n", first, "gear"},
       {"wrap: -1\n", first, "wrap"},
       {"scale: {torque: up}\n", first, "scale.torque"},
       {"- gear\n", file, "list"},
       {"", file, "nothing"},
       {"map: &a {time: *a}\n", file, "itself"}},
      [](const std::string& text) { ParseProject(text, "warmjoint.yaml"); });
}

}  // namespace
}  // namespace warmjoint
