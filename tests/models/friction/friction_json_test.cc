#include "models/friction/friction_json.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {
using nlohmann::json;
using testing::HasSubstr;

json Example() {
  return {
      {"law", "viscous_coulomb"},
      {"parameters", {{"viscous", 5.0}, {"coulomb", 15.0}}},
      {"thermal", {{"thermal_gain", -3.0}, {"thermal_time_constant", 600.0}, {"ambient", 21.0}}},
      {"gear", 100.0}};
}

std::string RefusalOf(const json& object) {
  return test::RefusalOf([&] { FrictionFrom({Tree(object), "robot.json"}); });
}

TEST(FrictionJson, SurvivesARoundTrip) {
  EXPECT_EQ(json(FrictionToTree(FrictionFrom({Tree(Example()), "robot.json"}))), Example());
}

TEST(FrictionJson, IsReadFromAnEstimateOrByItself) {
  const std::string path = testing::TempDir() + "/friction.json";
  for (const json& file : {Example(), json{{"identifier", "energy-ml"}, {"friction", Example()}}}) {
    WriteWholeFile(path, file.dump(2));
    EXPECT_EQ(ReadFriction(path).parameters.at("coulomb"), 15.0);
  }
  std::filesystem::remove(path);
}

TEST(FrictionJson, NamesTheLineThatIsNotJson) {
  const std::string path = testing::TempDir() + "/broken.json";
  WriteWholeFile(path, "{\n\"law\": \"coulomb\",\n}\n");
  try {
    ReadFriction(path);
    FAIL() << "accepted";
  } catch (const BadInput& refusal) {
    EXPECT_THAT(refusal.what(), HasSubstr("broken.json:3: is not JSON"));
  }
  std::filesystem::remove(path);
}

TEST(FrictionJson, RefusesUnknownNamesWithTheNearest) {
  json object = Example();
  object["law"] = "viscos_coulomb";
  EXPECT_THAT(RefusalOf(object), HasSubstr("did you mean 'viscous_coulomb'?"));
  object = Example();
  object["parameters"]["colomb"] = 1;
  EXPECT_THAT(RefusalOf(object), HasSubstr("did you mean 'coulomb'?"));
  object = Example();
  object["termal"] = 1;
  EXPECT_THAT(RefusalOf(object), HasSubstr("did you mean 'thermal'?"));
}

TEST(FrictionJson, TakesDefaultsForWhatMayBeLeftOut) {
  json object = Example();
  object["law"] = "stribeck";
  object["parameters"].update({{"static", 16.0}, {"stribeck_velocity", 0.1}});
  EXPECT_EQ(FrictionFrom({Tree(object), "robot.json"}).parameters.at("stribeck_exponent"), 2);
}

TEST(FrictionJson, RefusesALevelAtRestBelowThatOfSliding) {
  json object = Example();
  object["law"] = "asymmetric_stribeck";
  object["parameters"] = {{"viscous", 5.0},
                          {"coulomb_positive", 15.0},
                          {"coulomb_negative", 12.0},
                          {"static_rise", 3.0},
                          {"stribeck_velocity", 0.1}};
  EXPECT_EQ(RefusalOf(object), "accepted");
  object["parameters"]["static_rise"] = -1;
  EXPECT_THAT(RefusalOf(object), HasSubstr("static_rise is -1; it must be a finite number from 0"));
}

TEST(FrictionJson, SurvivesARoundTripWithAllItsParts) {
  json object = Example();
  object["thermal"]["second"] = {{"thermal_gain", -1.0}, {"thermal_time_constant", 20.0}};
  object["load_gain"] = 0.1;
  object["level_per_temperature"] = -0.2;
  object["viscous_per_energy"] = 0.3;
  object["maps"] = {{{"axes",
                      {{{"quantity", "energy"},
                        {"centres", {-1.0, 0.0}},
                        {"width", 1.0},
                        {"sides", "together"}}}},
                     {"kernels", "plain"},
                     {"factor", "direction"},
                     {"weights", {0.5, 0.25}}}};
  EXPECT_EQ(json(FrictionToTree(FrictionFrom({Tree(object), "robot.json"}))), object);
}

TEST(FrictionJson, RefusesPartsThatMakeNoSenseTogether) {
  json cold = Example();
  cold.erase("thermal");
  for (const char* option : {"level_per_temperature", "viscous_per_energy"}) {
    json object = cold;
    object[option] = -0.1;
    EXPECT_THAT(RefusalOf(object), HasSubstr(std::string(option) + " needs thermal"));
  }
  const json axis{{"quantity", "energy"}, {"centres", {-1.0, 0.0}}, {"width", 1.0}};
  cold["maps"] = {{{"axes", {axis}}, {"weights", {0.5, 0.25}}}};
  EXPECT_THAT(RefusalOf(cold), HasSubstr("a map over energy needs thermal"));

  json object = Example();
  object["viscous_per_energy"] = -0.1;
  EXPECT_THAT(RefusalOf(object), HasSubstr("their signs must differ"));
  object = Example();
  object["level_per_temperature"] = 0.1;
  EXPECT_THAT(RefusalOf(object), HasSubstr("losses would cool the joint"));
  object = Example();
  object["law"] = "coulomb";
  object["parameters"].erase("viscous");
  object["viscous_per_energy"] = 0.1;
  EXPECT_THAT(RefusalOf(object), HasSubstr("law coulomb has no viscous"));
  object = Example();
  object["load_gain"] = -1;
  EXPECT_THAT(RefusalOf(object), HasSubstr("load_gain is '-1'"));
  object = Example();
  object["maps"] = {{{"axes",
                      {{{"quantity", "motor_position"},
                        {"centres", {0.0, 3.0}},
                        {"width", 1.0},
                        {"period", 6.0}}}},
                     {"weights", {0.5, 0.25}}}};
  EXPECT_THAT(RefusalOf(object), HasSubstr("has the period 6; the motor's angle lies on a circle"));
}

TEST(FrictionJson, RefusesImpossibleValues) {
  json object = Example();
  object["parameters"]["coulomb"] = -1;
  EXPECT_THAT(RefusalOf(object), HasSubstr("robot.json: coulomb is -1"));
  object = Example();
  object["parameters"].erase("coulomb");
  EXPECT_THAT(RefusalOf(object), HasSubstr("lacks its parameter coulomb"));
  object = Example();
  object["thermal"]["thermal_time_constant"] = 0;
  EXPECT_THAT(RefusalOf(object),
              HasSubstr("thermal.thermal_time_constant is '0'; it must be a number above 0"));
  object = Example();
  object["law"] = "stribeck";
  object["parameters"].update({{"static", 14.0}, {"stribeck_velocity", 0.1}});
  EXPECT_THAT(RefusalOf(object), HasSubstr("static is 14; it must be at least coulomb, 15"));
  object["parameters"]["stribeck_exponent"] = 11;
  EXPECT_THAT(RefusalOf(object), HasSubstr("stribeck_exponent is 11"));
  object = Example();
  object["thermal"]["thermal_gain"] = "much";
  EXPECT_THAT(RefusalOf(object), HasSubstr("thermal.thermal_gain is 'much'"));
  object = Example();
  object["gear"] = 0;
  EXPECT_THAT(RefusalOf(object), HasSubstr("gear is 0"));
  EXPECT_THAT(RefusalOf(json::array()), HasSubstr("must be a map"));
}

}  // namespace
}  // namespace warmjoint
