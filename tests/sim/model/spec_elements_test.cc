#include "sim/model/spec_elements.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

using testing::ElementsAre;

/// Joints base (free), left.elbow, leftXelbow, ball (ball), slide (slide), a*b and one without name.
class MatchJointsOf : public testing::Test {
 protected:
  std::vector<std::string> Match(const std::string& pattern) {
    return MatchJoints(*spec_, pattern, {"robot.xml"});
  }

  static SpecPtr Parse() {
    char error[300] = "";
    SpecPtr spec(mj_parseXMLString(R"(<mujoco><worldbody>
      <body><freejoint name="base"/><geom size="0.1"/>
      <body><joint name="left.elbow"/><geom size="0.1"/>
      <body><joint name="leftXelbow"/><geom size="0.1"/>
      <body><joint name="ball" type="ball"/><geom size="0.1"/>
      <body><joint name="slide" type="slide"/><geom size="0.1"/>
      <body><joint name="a*b"/><geom size="0.1"/>
      <body><joint/><geom size="0.1"/>
      </body></body></body></body></body></body></body></worldbody></mujoco>)",
                                   nullptr, error, sizeof(error)));
    EXPECT_TRUE(spec) << error;
    return spec;
  }

  const SpecPtr spec_ = Parse();
};

TEST_F(MatchJointsOf, TakesTheNameOfAJointLiterally) {
  // as a pattern it would mean leftXelbow, too
  EXPECT_THAT(Match("left.elbow"), ElementsAre("left.elbow"));
  EXPECT_THAT(Match("a*b"), ElementsAre("a*b"));
  EXPECT_THAT(Match("ball"), ElementsAre("ball"));
}

TEST_F(MatchJointsOf, MatchesWholeNamesOfHingesAndSlides) {
  EXPECT_THAT(Match("left.*"), ElementsAre("left.elbow", "leftXelbow"));
  EXPECT_THAT(Match(".*"), ElementsAre("left.elbow", "leftXelbow", "slide", "a*b"));
  EXPECT_THAT(Match("(left|right)[.]elbow|slide"), ElementsAre("left.elbow", "slide"));
}

TEST_F(MatchJointsOf, CountsTheNamelessThatNoPatternMeans) { EXPECT_EQ(NamelessJoints(*spec_), 1); }

TEST_F(MatchJointsOf, RefusesWhatMeansNoJoint) {
  const auto refusal = [&](const char* pattern) {
    return test::RefusalOf([&] { Match(pattern); });
  };
  test::ExpectNamed(refusal("slid"), {"robot.xml: ", "'slid'", "did you mean 'slide'"});
  test::ExpectNamed(refusal("ba.*"), {"robot.xml: ", "'ba.*'", "left.elbow"});
  test::ExpectNamed(refusal("left[.elbow"), {"robot.xml: ", "'left[.elbow'", "regular expression"});
  test::ExpectNamed(refusal("*"), {"robot.xml: ", "write '.*', as '.*'"});
  test::ExpectNamed(refusal("elbow_*"), {"robot.xml: ", "as 'elbow_.*'"});
}

}  // namespace
}  // namespace warmjoint
