#include "models/friction/friction_json.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "tests/models/recording/temporary_file.h"
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

TEST(FrictionJson, IsReadFromAnEstimateOrByItself) {
  const TemporaryFile given("friction.json");
  for (const json& file : {Example(), json{{"identifier", "energy-ml"}, {"friction", Example()}}}) {
    WriteWholeFile(given.path(), file.dump(2));
    EXPECT_EQ(ReadFriction(given.path()).parameters.at("coulomb"), 15.0);
  }
}

TEST(FrictionJson, TakesDefaultsForWhatMayBeLeftOut) {
  json object = Example();
  object["law"] = "stribeck";
  object["parameters"].update({{"static", 16.0}, {"stribeck_velocity", 0.1}});
  EXPECT_EQ(FrictionFrom({Tree(object), "robot.json"}).parameters.at("stribeck_exponent"), 2);
}

TEST(FrictionJson, SurvivesARoundTripWithAndWithoutAllItsParts) {
  json object = Example();
  EXPECT_EQ(json(FrictionToTree(FrictionFrom({Tree(object), "robot.json"}))), object);
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

TEST(FrictionJson, RefusesWhatIsUnknownImpossibleOrMakesNoSenseTogether) {
  // what becomes of the example, a JSON merge patch, and what refuses that
  const std::vector<std::pair<const char*, const char*>> rows{
      // names
      {R"({"law": "viscos_coulomb"})", "did you mean 'viscous_coulomb'?"},
      {R"({"parameters": {"colomb": 1}})", "did you mean 'coulomb'?"},
      {R"({"termal": 1})", "did you mean 'thermal'?"},
      // parts that belong together
      {R"({"thermal": null, "level_per_temperature": -0.1})",
       "level_per_temperature needs thermal"},
      {R"({"thermal": null, "viscous_per_energy": -0.1})", "viscous_per_energy needs thermal"},
      {R"({"thermal": null, "maps": [{"weights": [0.5, 0.25],
            "axes": [{"quantity": "energy", "centres": [-1, 0], "width": 1}]}]})",
       "a map over energy needs thermal"},
      {R"({"viscous_per_energy": -0.1})", "their signs must differ"},
      {R"({"level_per_temperature": 0.1})", "losses would cool the joint"},
      {R"({"law": "coulomb", "parameters": {"viscous": null}, "viscous_per_energy": 0.1})",
       "law coulomb has no viscous"},
      {R"({"load_gain": -1})", "load_gain is '-1'"},
      {R"({"maps": [{"weights": [0.5, 0.25],
            "axes": [{"quantity": "motor_position", "centres": [0, 3], "width": 1, "period": 6}]}]})",
       "has the period 6; the motor's angle lies on a circle"},
      // values
      {R"({"parameters": {"coulomb": -1}})", "robot.json: coulomb is -1"},
      {R"({"parameters": {"coulomb": null}})", "lacks its parameter coulomb"},
      {R"({"thermal": {"thermal_time_constant": 0}})",
       "thermal.thermal_time_constant is '0'; it must be a number above 0"},
      {R"({"law": "stribeck", "parameters": {"static": 14, "stribeck_velocity": 0.1}})",
       "static is 14; it must be at least coulomb, 15"},
      {R"({"law": "stribeck", "parameters": {"static": 16, "stribeck_velocity": 0.1,
            "stribeck_exponent": 11}})",
       "stribeck_exponent is 11"},
      {R"({"law": "asymmetric_stribeck", "parameters": {"coulomb": null,
            "coulomb_positive": 15, "coulomb_negative": 12, "static_rise": -1,
            "stribeck_velocity": 0.1}})",
       "static_rise is -1; it must be a finite number from 0"},
      {R"({"thermal": {"thermal_gain": "much"}})", "thermal.thermal_gain is 'much'"},
      {R"({"gear": 0})", "gear is 0"}};
  for (const auto& [patch, refusal] : rows) {
    json object = Example();
    object.merge_patch(json::parse(patch));
    EXPECT_THAT(RefusalOf(object), HasSubstr(refusal)) << patch;
  }
  EXPECT_THAT(RefusalOf(json::array()), HasSubstr("must be a map"));
}

}  // namespace
}  // namespace warmjoint
