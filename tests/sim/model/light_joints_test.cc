// Which joints a name or a pattern means, and those that are too light for a friction.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/attach.h>

#include <regex>

#include "models/foundation/atomic_file.h"
#include "sim/model/spec_elements.h"
#include "tests/sim/plugin/friction_models.h"
#include "tests/support/refusal.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Without a level, and with a slope over speed at every position that the plugin itself adds.
Friction Steep() {
  Friction friction{"coulomb", {{"coulomb", 0}}, {}};
  FrictionMap map;
  map.axes = {{MapQuantity::position, EvenAxis(-1, 1, 2)}};
  map.weights = {30, 30};
  map.factor = MapFactor::velocity;
  friction.maps = {map};
  return friction;
}

/// Frictions that the light joints of LightJoints do not carry at 2 ms.
const Friction kFrictions[] = {{"coulomb", {{"coulomb", 6}}, {}},
                               Steep(),
                               {"lugre",
                                {{"coulomb", 1},
                                 {"static", 1},
                                 {"viscous", 0},
                                 {"stribeck_velocity", 0.1},
                                 {"bristle_stiffness", 1e5},
                                 {"bristle_damping", 10}},
                                {}}};

/// An arm whose last two links weigh grams.
class LightJoints : public testing::Test {
 protected:
  LightJoints() {
    WriteWholeFile(folder_.path() / "arm.xml",
                   R"(<mujoco><option timestep="0.002"/><worldbody><body>
    <joint name="heavy" axis="0 1 0"/><geom type="box" size="0.5 0.5 0.5" mass="1000"/>
    <body pos="0.1 0 0"><joint name="wrist" axis="0 1 0" armature="1e-5"/>
    <geom size="0.01" mass="0.01"/>
    <body pos="0.1 0 0"><joint name="finger" type="slide"/><geom size="0.01" mass="0.01"/>
    </body></body></body></worldbody></mujoco>)");
  }

  std::string Refusal(const Friction& friction, const AttachOptions& options) const {
    return test::RefusalOf([&] {
      AttachFriction(folder_.path() / "arm.xml", {{".*", friction}}, folder_.path() / "out.xml",
                     options);
    });
  }

  const ScratchDirectory folder_;
};

TEST_F(LightJoints, AreRefusedWithArmaturesOrATimestepThatAreThenAccepted) {
  for (const Friction& friction : kFrictions) {
    SCOPED_TRACE(friction.law);
    const std::string refusal = Refusal(friction, {});
    EXPECT_THAT(refusal, Not(HasSubstr("--armature heavy")));
    AttachOptions heavier;
    const std::regex offer("--armature ([a-z]+)=([-+.e0-9]+)");
    for (std::sregex_iterator i(refusal.begin(), refusal.end(), offer), end; i != end; ++i) {
      heavier.armatures.push_back({(*i)[1], std::stod((*i)[2])});
    }
    ASSERT_EQ(heavier.armatures.size(), 2u) << refusal;
    EXPECT_EQ(Refusal(friction, heavier), "accepted");

    // and not by much too large: a tenth less of the first is refused
    heavier.armatures.front().value *= 0.9;
    EXPECT_THAT(Refusal(friction, heavier), HasSubstr("wrist"));

    std::smatch step;
    ASSERT_TRUE(std::regex_search(refusal, step, std::regex("--timestep ([-+.e0-9]+)"))) << refusal;
    AttachOptions shorter;
    shorter.timestep = std::stod(step[1]);
    EXPECT_LT(*shorter.timestep, 0.002);
    EXPECT_EQ(Refusal(friction, shorter), "accepted");
  }
}

/// Joints base (free), left.elbow, leftXelbow, ball (ball), slide (slide), a*b and one without name.
class MatchJointsOf : public testing::Test {
 protected:
  std::vector<std::string> Match(const std::string& pattern) {
    return MatchJoints(*spec_, pattern, {"robot.xml"});
  }

  const SpecPtr spec_ = test::ParseXml(R"(<mujoco><worldbody>
      <body><freejoint name="base"/><geom size="0.1"/>
      <body><joint name="left.elbow"/><geom size="0.1"/>
      <body><joint name="leftXelbow"/><geom size="0.1"/>
      <body><joint name="ball" type="ball"/><geom size="0.1"/>
      <body><joint name="slide" type="slide"/><geom size="0.1"/>
      <body><joint name="a*b"/><geom size="0.1"/>
      <body><joint/><geom size="0.1"/>
      </body></body></body></body></body></body></body></worldbody></mujoco>)");
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
