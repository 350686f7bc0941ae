// Which joints a name or a pattern means, and those that are too light for a friction.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/attach.h>

#include <ostream>
#include <regex>

#include "models/foundation/atomic_file.h"
#include "sim/model/friction_actuator.h"
#include "sim/model/spec_elements.h"
#include "tests/support/refusal.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A friction, printed by the name of its law.
struct Case {
  Friction friction;
};
void PrintTo(const Case& of, std::ostream* stream) { *stream << of.friction.law; }

/// An arm whose last two links weigh grams, with friction that none of its joints carries at 2 ms.
class LightJoints : public testing::TestWithParam<Case> {
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

  std::string Refusal(const AttachOptions& options) const {
    return test::RefusalOf([&] {
      AttachFriction(folder_.path() / "arm.xml", {{".*", GetParam().friction}},
                     folder_.path() / "out.xml", options);
    });
  }

  const ScratchDirectory folder_;
};

TEST_P(LightJoints, AreRefusedWithArmaturesThatAreThenAccepted) {
  const std::string refusal = Refusal({});
  EXPECT_THAT(refusal, Not(HasSubstr("--armature heavy")));
  AttachOptions options;
  const std::regex offer("--armature ([a-z]+)=([-+.e0-9]+)");
  for (std::sregex_iterator i(refusal.begin(), refusal.end(), offer), end; i != end; ++i) {
    options.armatures.push_back({(*i)[1], std::stod((*i)[2])});
  }
  ASSERT_EQ(options.armatures.size(), 2u) << refusal;
  EXPECT_EQ(Refusal(options), "accepted");

  // and not by much too large: a tenth less of the first is refused
  options.armatures.front().value *= 0.9;
  EXPECT_THAT(Refusal(options), HasSubstr("wrist"));
}

TEST_P(LightJoints, AreRefusedWithATimestepThatIsThenAccepted) {
  const std::string refusal = Refusal({});
  std::smatch offer;
  ASSERT_TRUE(std::regex_search(refusal, offer, std::regex("--timestep ([-+.e0-9]+)"))) << refusal;
  AttachOptions options;
  options.timestep = std::stod(offer[1]);
  EXPECT_LT(*options.timestep, 0.002);
  EXPECT_EQ(Refusal(options), "accepted");
}

Case OfLaw(const std::string& law, std::map<std::string, double> parameters) {
  return {{law, std::move(parameters), {}}};
}

INSTANTIATE_TEST_SUITE_P(Frictions, LightJoints,
                         testing::Values(OfLaw("coulomb", {{"coulomb", 6}}),
                                         OfLaw("viscous_coulomb",
                                               {{"coulomb", 0}, {"viscous", 30}}),
                                         OfLaw("lugre", {{"coulomb", 1},
                                                         {"static", 1},
                                                         {"viscous", 0},
                                                         {"stribeck_velocity", 0.1},
                                                         {"bristle_stiffness", 1e5},
                                                         {"bristle_damping", 10}})),
                         [](const auto& of) { return of.param.friction.law; });

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
