#include "tools/actions/project_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/foundation/bad_input.h"
#include "models/foundation/serialize.h"

namespace warmjoint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

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

std::string Refusal(const std::string& text) {
  try {
    ParseProject(text, "warmjoint.yaml");
  } catch (const BadInput& error) {
    return error.what();
  }
  return "(accepted)";
}

TEST(ProjectFile, CannotNameWhatRuns) {
  EXPECT_THAT(Refusal("gear: 2\nidentifier: \"mine=sh {recording} {estimate}\"\n"),
              HasSubstr("warmjoint.yaml:2: 'identifier' does not belong here"));
  EXPECT_THAT(Refusal("command: touch P\n"), HasSubstr("warmjoint.yaml:1: 'command' does not"));
  EXPECT_THAT(Refusal("set:\n  command: x\n"), HasSubstr("'set' does not belong here"));
}

TEST(ProjectFile, RefusesWhatItDoesNotKnowWithLineAndRemedy) {
  EXPECT_THAT(Refusal("joint: rotary\ngaer: 50\n"),
              HasSubstr("warmjoint.yaml:2: unknown key 'gaer'; did you mean 'gear'"));
  EXPECT_THAT(Refusal("map: {torqe: f}\n"), HasSubstr("did you mean 'torque'"));
  EXPECT_THAT(Refusal("unit: {position: degree}\n"), HasSubstr("warmjoint.yaml:1: position"));
  EXPECT_THAT(Refusal("joint: prismatic\n"), HasSubstr("joint is 'prismatic'"));
  EXPECT_THAT(Refusal("gear: 0\n"), HasSubstr("gear"));
  EXPECT_THAT(Refusal("gear: .inf\n"), HasSubstr("gear"));
  EXPECT_THAT(Refusal("wrap: -1\n"), HasSubstr("wrap"));
  EXPECT_THAT(Refusal("scale: {torque: up}\n"), HasSubstr("scale.torque"));
  EXPECT_THAT(Refusal("- gear\n"), HasSubstr("the document is a list"));
  EXPECT_THAT(Refusal(""), HasSubstr("the document is nothing"));
  EXPECT_THAT(Refusal("map: &a {time: *a}\n"), HasSubstr("warmjoint.yaml"));
}

}  // namespace
}  // namespace warmjoint
