#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "identification/estimate.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

Estimate Example() {
  Estimate estimate;
  estimate.identifier = "energy-als";
  estimate.status = Status::not_converged;
  estimate.message = "The parameters still move.";
  estimate.parameters = {{"coulomb", 15.1, "N.m", 0.2, {{14.7, 15.5}}},
                         {"viscous", 1.0 / 3, "N.m.s/rad", {}, {}}};
  estimate.metrics = Metrics{3600, 4, 3.5, 0.5, 0.4, 93.25, 0.2506};
  estimate.trace = {{0, {{"coulomb", 9.0}, {"viscous", 4.5}}, 1.9},
                    {1, {{"coulomb", 10.0}, {"viscous", 4.75}}, 1.5}};
  estimate.friction = Friction{
      "viscous_coulomb", {{"viscous", 1.0 / 3}, {"coulomb", 15.1}}, Thermal{-3, 600}, 20, 50};
  return estimate;
}

std::string Refusal(const json& object) {
  return test::RefusalOf([&] { EstimateFrom({Tree(object), "estimate.json"}); });
}

TEST(EstimateJson, HoldsTheKeysOfTheContract) {
  const json object = EstimateToTree(Example());
  EXPECT_EQ(object["identifier"], "energy-als");
  EXPECT_EQ(object["status"], "not_converged");
  EXPECT_EQ(object["parameters"]["coulomb"],
            json({{"value", 15.1}, {"unit", "N.m"}, {"std", 0.2}, {"interval95", {14.7, 15.5}}}));
  EXPECT_EQ(object["metrics"]["effective_parameters"], 3.5);
  EXPECT_TRUE(object["holdout"].is_null());
  EXPECT_EQ(object["trace"][1]["parameters"]["viscous"], 4.75);
  EXPECT_EQ(object["friction"]["thermal"]["thermal_gain"], -3);
}

TEST(EstimateJson, ReadsBackBitForBit) {
  const json object = EstimateToTree(Example());
  const Estimate back = EstimateFrom({Tree(json::parse(object.dump())), "estimate.json"});
  EXPECT_EQ(json(EstimateToTree(back)), object);
  EXPECT_EQ(back.Find("viscous")->value, 1.0 / 3);
  EXPECT_FALSE(back.Find("viscous")->std);
  EXPECT_EQ(back.Find("gain"), nullptr);
}

TEST(EstimateJson, KeepsFrictionAtSpeeds) {
  Estimate estimate = Example();
  EXPECT_FALSE(EstimateToTree(estimate).contains("friction_at_speeds"));
  estimate.friction_at_speeds = {{0.3, 2.15, 0.01, {2.13, 2.17}, "m/s", "N"},
                                 {0.8, 2.4, 0.02, {2.36, 2.44}}};
  const json object = EstimateToTree(estimate);
  EXPECT_EQ(object["friction_at_speeds"][0], json({{"speed", 0.3},
                                                   {"value", 2.15},
                                                   {"std", 0.01},
                                                   {"interval95", {2.13, 2.17}},
                                                   {"speed_unit", "m/s"},
                                                   {"unit", "N"}}));
  EXPECT_EQ(json(EstimateToTree(EstimateFrom({Tree(object), "estimate.json"}))), object);

  json wrong = object;
  wrong["friction_at_speeds"][1]["interval95"] = 3;
  EXPECT_THAT(Refusal(wrong), HasSubstr("friction_at_speeds.1.interval95 is '3'"));
}

TEST(EstimateJson, KeepsWarningsApartAndInTheMessage) {
  Estimate estimate = Example();
  EXPECT_FALSE(EstimateToTree(estimate).contains("warnings"));
  estimate.warnings = {"the kernels can imitate coulomb; so", "time; is short"};
  const json object = EstimateToTree(estimate);
  EXPECT_EQ(object["message"],
            "The parameters still move.; the kernels can imitate coulomb; so; time; is short");
  const Estimate back = EstimateFrom({Tree(object), "estimate.json"});
  EXPECT_EQ(back.message, estimate.message);
  EXPECT_EQ(back.warnings, estimate.warnings);

  // others may warn without repeating themselves
  json theirs = object;
  theirs["message"] = "done";
  EXPECT_EQ(EstimateFrom({Tree(theirs), "estimate.json"}).FullMessage(),
            "done; the kernels can imitate coulomb; so; time; is short");
  theirs["warnings"] = {1};
  EXPECT_THAT(Refusal(theirs), HasSubstr("warnings.0 is '1'; it must be text"));
}

TEST(EstimateJson, NeverWritesNanOrInfinityAsANumber) {
  Estimate estimate = Example();
  estimate.parameters[0].value = std::numeric_limits<double>::quiet_NaN();
  estimate.parameters[0].std = std::numeric_limits<double>::infinity();
  estimate.metrics->fit = -std::numeric_limits<double>::infinity();
  estimate.trace[0].rmse = std::numeric_limits<double>::quiet_NaN();

  const json object = EstimateToTree(estimate);
  EXPECT_TRUE(object["parameters"]["coulomb"]["value"].is_null());
  EXPECT_TRUE(object["parameters"]["coulomb"]["std"].is_null());
  EXPECT_TRUE(object["metrics"]["fit"].is_null());
  EXPECT_TRUE(object["trace"][0]["rmse"].is_null());
  EXPECT_TRUE(std::isnan(EstimateFrom({Tree(object), "estimate.json"}).metrics->fit));
}

TEST(EstimateJson, KeepsEveryStatus) {
  for (const char* name :
       {"ok", "not_converged", "not_identifiable", "inadequate_model", "bad_data"}) {
    json object = EstimateToTree(Example());
    object["status"] = name;
    EXPECT_EQ(StatusName(EstimateFrom({Tree(object), "estimate.json"}).status), name);
  }
}

TEST(EstimateJson, RefusesABrokenContractWithThePlace) {
  test::ExpectNames(Refusal(json::array()), "estimate.json", "list");
  test::ExpectNames(Refusal({{"identifier", "x"}}), "estimate.json", "'status'");
  const std::vector<std::pair<std::string, json>> rows{{"/status", "okay"},
                                                       {"/parameters/coulomb/value", "15"},
                                                       {"/parameters/coulomb/interval95", {1}},
                                                       {"/metrics/n", 1.5}};
  for (const auto& [place, wrong] : rows) {
    json object = EstimateToTree(Example());
    object[json::json_pointer(place)] = wrong;
    std::string key = place.substr(1);
    std::replace(key.begin(), key.end(), '/', '.');
    test::ExpectNames(Refusal(object), "estimate.json: ", key);
  }
}

}  // namespace
}  // namespace warmjoint
