#include "sim/plugin/attributes.h"

#include <gmock/gmock.h>

#include <fstream>
#include <string>
#include <vector>

#include "models/foundation/atomic_file.h"
#include "sim/model/friction_sections.h"
#include "tests/sim/plugin/friction_models.h"
#include "tests/support/folders.h"

namespace warmjoint {
namespace {

using namespace test;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string ErrorOf(const Config& config, const std::string& attributes = "",
                    const std::string& option = kNoGravity, const std::string& joint = "") {
  return Compile(LinkXml(FrictionSection(config, {attributes}), option, joint)).error;
}

const Config kGood{{"law", "viscous_coulomb"}, {"viscous", "5"}, {"coulomb", "15"}};

Config With(const std::string& key, const std::string& value) {
  Config config = kGood;
  config[key] = value;
  return config;
}

TEST(PluginAttributes, LoadWhereTheyAreRight) { EXPECT_EQ(ErrorOf(kGood), ""); }

TEST(PluginAttributes, RefuseATextInANumber) {
  EXPECT_THAT(ErrorOf(With("viscous", "5x")),
              AllOf(HasSubstr("actuator 'f'"), HasSubstr("viscous is '5x'"), HasSubstr("number")));
  EXPECT_THAT(ErrorOf(With("coulomb", "nan")), HasSubstr("coulomb is nan; it must be a finite"));
}

TEST(PluginAttributes, RefuseAValueOutOfBounds) {
  EXPECT_THAT(ErrorOf(With("coulomb", "-3")),
              AllOf(HasSubstr("actuator 'f'"), HasSubstr("coulomb is -3"), HasSubstr("from 0")));
  EXPECT_THAT(ErrorOf(With("gear", "0")), HasSubstr("gear is 0"));
}

TEST(PluginAttributes, RefuseNumbersThatSlipped) {
  EXPECT_THAT(ErrorOf(With("load_gain", "1e9")),
              AllOf(HasSubstr("actuator 'f'"), HasSubstr("load_gain is 1000000000"),
                    HasSubstr("from 0 to 100")));
  Config hot = With("thermal_time_constant", "10");
  hot["thermal_gain"] = "-1e300";
  EXPECT_THAT(ErrorOf(hot), AllOf(HasSubstr("actuator 'f'"), HasSubstr("thermal_gain is -1e+300"),
                                  HasSubstr("from -1000000")));
}

TEST(PluginAttributes, TellARefusalOnce) {
  // those of actdim and of the give are found last, when the engine makes its data
  std::vector<std::string> errors{
      Compile(LinkXml(FrictionSection(kGood, {.states = 3}), kNoGravity)).error};
  for (const Config& config : {Config{{"coulomb", "6"}}, With("viscous", "-1"), With("maps", "["),
                               With("coulomb", "100000")}) {
    errors.push_back(ErrorOf(config));
  }
  for (const std::string& error : errors) {
    const std::string start = "warmjoint.friction: actuator 'f': ";
    const size_t first = error.find(start);
    ASSERT_NE(first, std::string::npos) << error;
    EXPECT_EQ(error.find(start, first + 1), std::string::npos) << error;
  }
}

TEST(PluginAttributes, RefuseAnActdimBelowOne) {
  EXPECT_THAT(Compile(LinkXml(FrictionSection(kGood, {.states = -1}), kNoGravity)).error,
              HasSubstr("actdim is not given, or below 1; it must be 2 (bristle load, energy)"));
}

TEST(PluginAttributes, RefuseAnUnknownKeyLawOrParameter) {
  EXPECT_THAT(ErrorOf(With("viscos", "5")), HasSubstr("viscos"));
  EXPECT_THAT(ErrorOf(With("law", "viscous_coulom")), HasSubstr("did you mean 'viscous_coulomb'"));
  EXPECT_THAT(ErrorOf(With("coulomb_positive", "5")),
              HasSubstr("law viscous_coulomb has no parameter 'coulomb_positive'"));
}

TEST(PluginAttributes, RefuseWhatIsMissing) {
  EXPECT_THAT(ErrorOf({{"law", "viscous_coulomb"}, {"viscous", "5"}}), HasSubstr("lacks its"));
  EXPECT_THAT(ErrorOf({{"viscous", "5"}}), HasSubstr("law is missing"));
  EXPECT_THAT(ErrorOf(With("thermal_gain", "-3")), HasSubstr("give both or neither"));
}

TEST(PluginAttributes, ReadAFrictionFileInstead) {
  const std::string path = testing::TempDir() + "/friction_of_attributes_test.json";
  WriteWholeFile(path, R"({"law": "coulomb", "parameters": {"coulomb": 6}})");
  EXPECT_EQ(ErrorOf({{"file", path}}), "");
  EXPECT_THAT(ErrorOf({{"file", path}, {"law", "coulomb"}}), HasSubstr("beside file"));
  EXPECT_THAT(ErrorOf({{"file", path + "x"}}), HasSubstr("cannot be read"));
}

TEST(PluginAttributes, HoldTheFrictionOfSeveralJoints) {
  const auto error = [](const std::string& joints) {
    return ErrorOf({{"joints", EscapeXml(joints)}});
  };
  EXPECT_EQ(error(R"({"hinge": {"law": "coulomb", "parameters": {"coulomb": 6}}})"), "");
  EXPECT_THAT(error("[]"), HasSubstr("joints must be a JSON object"));
  EXPECT_THAT(error(R"({"hinge": {"law": "coulomb", "parameters": {"coulomb": -6}}})"),
              AllOf(HasSubstr("actuator 'f': joints: hinge"), HasSubstr("coulomb is -6")));
  EXPECT_THAT(error(R"({"hing": {"law": "coulomb", "parameters": {"coulomb": 6}}})"),
              HasSubstr("joints has no joint 'hinge'; did you mean 'hing'"));
  EXPECT_THAT(error(R"({"hinge": {"law": "coulomb", "parameters": {"coulomb": 6}},
                        "elbow": {"law": "coulomb", "parameters": {"coulomb": 6}}})"),
              HasSubstr("joints names 'elbow', which no actuator"));
  EXPECT_THAT(ErrorOf({{"joints", "{}"}, {"law", "coulomb"}}), HasSubstr("beside joints"));
  EXPECT_THAT(error(R"({"hinge": {"law": "coulomb", "parameters": {"coulomb": 6}},
                        "hinge": {"law": "coulomb", "parameters": {"coulomb": 5}}})"),
              HasSubstr("joints names 'hinge' twice"));
}

TEST(PluginActuator, RefusesWhatWouldBreakFriction) {
  EXPECT_THAT(ErrorOf(kGood, R"(forcerange="-1 1")"), HasSubstr("forcerange"));
  EXPECT_THAT(ErrorOf(kGood, R"(gear="2")"), HasSubstr("gear is 2"));
  EXPECT_THAT(ErrorOf(kGood, "", kNoGravity, R"(actuatorfrcrange="-9 9")"),
              HasSubstr("joint 'hinge' has actuatorfrcrange"));
}

TEST(PluginActuator, RefusesASecondFrictionOnItsJoint) {
  const std::string one = FrictionSection(kGood);
  const std::string two = one + FrictionSection(kGood);
  const size_t name = two.rfind("name=\"f\"");
  const std::string named = two.substr(0, name) + "name=\"g\"" + two.substr(name + 8);
  EXPECT_THAT(Compile(LinkXml(named, kNoGravity)).error,
              HasSubstr("actuator 'g': joint 'hinge' has friction already, by actuator 'f'"));
}

TEST(PluginActuator, RefusesAnInertiaTooSmallForTheSlopeAndSaysWhatItNeeds) {
  // inertia 0.25 kg.m^2, 250 N.m.s/rad at 1 ms needs 0.5 kg.m^2
  const std::string error = ErrorOf(With("viscous", "250"));
  EXPECT_THAT(error, AllOf(HasSubstr("actuator 'f'"), HasSubstr("armature of 0.25"),
                           HasSubstr("timestep of at most 0.0005")));
  EXPECT_EQ(ErrorOf(With("viscous", "250"), "", kNoGravity, R"(armature="0.253")"), "");
}

TEST(PluginActuator, RefusesABristleThatTheStepCannotCarry) {
  Config config{{"law", "dahl"}, {"coulomb", "5"}, {"bristle_stiffness", "1e6"}};
  // 1e6 N.m/rad at 1 ms needs 1 / 0.9 kg.m^2 of inertia; the link has 0.25
  EXPECT_THAT(ErrorOf(config), AllOf(HasSubstr("bristle_stiffness is 1000000"),
                                     HasSubstr("armature of 0.87"), HasSubstr("0.000474 s")));
  config["bristle_stiffness"] = "1e4";
  EXPECT_EQ(ErrorOf(config), "");
}

TEST(PluginActuator, RefusesTheWrongNumberOfStates) {
  const Config stiction{{"law", "stiction"}, {"viscous", "1"}, {"coulomb", "5"}, {"static", "6"}};
  EXPECT_THAT(ErrorOf(stiction),
              HasSubstr("actdim is 2; it must be 3 (bristle load, energy, slip)"));
  EXPECT_THAT(ErrorOf(kGood, R"(actlimited="true" actrange="-1 1")"), HasSubstr("actrange"));
}

TEST(PluginReadme, HasAModelThatRuns) {
  const std::string readme = ReadWholeFile(test::SourceFolder() / "sim/plugin/README.md");
  const size_t begin = readme.find("```xml\n") + 7;
  const auto compiled = Compile(readme.substr(begin, readme.find("```", begin) - begin));
  ASSERT_EQ(compiled.error, "");

  // the link falls, and its friction gets warm
  const Data d(mj_makeData(compiled.model.get()));
  for (int i = 0; i < 300; ++i) mj_step(compiled.model.get(), d.get());
  EXPECT_GT(d->qpos[0], 0.01);
  EXPECT_LT(d->act[1], 0);
}

}  // namespace
}  // namespace warmjoint
