#include "sim/model/attach.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/model/spec_elements.h"

namespace warmjoint {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// One hinge `j`, limited to -4 to 3, and these actuators.
SpecPtr Limited(const std::string& actuators) {
  const std::string text = R"(<mujoco><worldbody><body>
      <joint name="j" axis="0 1 0" actuatorfrcrange="-4 3"/><geom size="0.1"/>
      <body><joint name="free"/><geom size="0.1"/></body></body></worldbody>
      <actuator>)" + actuators +
                           "</actuator></mujoco>";
  char error[300] = "";
  SpecPtr spec(mj_parseXMLString(text.c_str(), nullptr, error, sizeof(error)));
  EXPECT_TRUE(spec) << error;
  return spec;
}

const mjsActuator& Actuator(mjSpec& spec, int i) {
  return *mjs_asActuator(SpecElements(spec, mjOBJ_ACTUATOR)[static_cast<size_t>(i)]);
}

TEST(MoveEffortLimits, CutsTheRangeOfTheMotorToThatOfTheJoint) {
  const SpecPtr spec = Limited(R"(<motor joint="j" forcerange="-2 9"/>)");
  EXPECT_THAT(MoveEffortLimits(*spec, {"j"}, {}), ElementsAre(HasSubstr("j: ")));
  EXPECT_THAT(Actuator(*spec, 0).forcerange, ElementsAre(-2, 3));
  const ModelPtr m(mj_compile(spec.get(), nullptr));
  EXPECT_FALSE(m->jnt_actfrclimited[0]);
}

TEST(MoveEffortLimits, CountsTheGearOfTheMotor) {
  const SpecPtr spec = Limited(R"(<motor joint="j" gear="-2"/>)");
  MoveEffortLimits(*spec, {"j"}, {});
  // -4 to 3 N.m at the joint are 2 to -1.5 at a motor of gear -2
  EXPECT_THAT(Actuator(*spec, 0).forcerange, ElementsAre(-1.5, 2));
}

TEST(MoveEffortLimits, SaysThatSeveralMotorsAreNoLongerLimitedTogether) {
  const SpecPtr spec =
      Limited(R"(<position joint="j"/><velocity joint="j"/><motor joint="free"/>)");
  EXPECT_THAT(MoveEffortLimits(*spec, {"j"}, {}), ElementsAre(HasSubstr("their sum")));
  EXPECT_THAT(Actuator(*spec, 0).forcerange, ElementsAre(-4, 3));
  EXPECT_THAT(Actuator(*spec, 1).forcerange, ElementsAre(-4, 3));
  EXPECT_THAT(Actuator(*spec, 2).forcerange, ElementsAre(0, 0));
}

TEST(MoveEffortLimits, AddsNoMotorToAJointWithoutOne) {
  const SpecPtr spec = Limited("");
  EXPECT_THAT(MoveEffortLimits(*spec, {"j"}, {}),
              ElementsAre(AllOf(HasSubstr("j (-4 to 3)"), HasSubstr("no actuator"))));
  EXPECT_THAT(SpecElements(*spec, mjOBJ_ACTUATOR), IsEmpty());
}

TEST(MoveEffortLimits, LeavesJointsWithoutLimitAlone) {
  const SpecPtr spec = Limited(R"(<motor joint="free"/>)");
  EXPECT_THAT(MoveEffortLimits(*spec, {"free"}, {}), IsEmpty());
  EXPECT_NE(Actuator(*spec, 0).forcelimited, mjLIMITED_TRUE);
}

}  // namespace
}  // namespace warmjoint
