#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/estimate.h>

#include <cmath>

#include "tests/tools/scratch_directory.h"

namespace warmjoint::api {
namespace {

using testing::HasSubstr;

/// Every member set.
Estimate Everything() {
  Estimate estimate;
  estimate.identifier = "hand";
  estimate.status = Status::inadequate_model;
  estimate.message = "it does not fit";
  estimate.warnings = {"the first", "the second"};
  estimate.parameters = {{"coulomb", 15, "N.m", 0.1, {{14.8, 15.2}}},
                         {"viscous", NAN, "N.m", {}, {}}};
  estimate.metrics = Metrics{100, 2, 1.5, 0.2, 0.1, 97, 0.04};
  estimate.holdout = Metrics{40, 2, 1.5, 0.3, 0.2, 90, 0.09};
  estimate.trace = {{1, {{"coulomb", 14}}, 0.5}, {2, {{"coulomb", 15}}, 0.2}};
  estimate.friction.emplace();
  estimate.friction->parameters = {{"viscous", 5}, {"coulomb", 15}};
  estimate.gravity = Gravity{"paired", {3, 4}, {0.5, 0.6}};
  estimate.bands = {{{"position"}, {{0.1}, {0.2}}, {1, 2}, {0.1, 0.1}, {{0.8, 1.2}, {1.8, 2.2}}}};
  estimate.covariance = Covariance{{"coulomb", "viscous"}, {{1, 0.5}, {0.5, 2}}};
  estimate.diagnostics = {
      {"lag", true, "found", 6, 1e-9, 1e-8, true, 0.3, "N.m", {{"coulomb", 0.4}}},
      {"direction", false, "too few samples", 0, 1, 1, false, 0, "", {}}};
  estimate.assumptions = {{"cold_start", "a tenth of the warmth", {{"coulomb", 0.1}}}};
  Origin origin;
  origin.files = {"a.csv", "b.csv"};
  origin.read.map = {{"torque", "force"}};
  origin.read.unit = {{"position", "mm"}};
  origin.read.scale = {{"torque", -0.5}};
  origin.read.wrap = 10;
  origin.read.joint = JointKind::linear;
  origin.read.gear = 2;
  origin.prepare = {1, 3};
  origin.project_file = "warmjoint.yaml";
  origin.project = R"({"map":["torque=force"],"joint":"linear","gear":2.0,"shortest_hold":3.0})";
  estimate.recording = origin;
  estimate.follows = CarriedHeat{"monday.json", 300, "given", "N", {-2, -0.5}, {0.1, 0.2}};
  return estimate;
}

TEST(Estimate, ComesBackFromItsFileWithEveryMember) {
  const ScratchDirectory scratch;
  WriteEstimate(Everything(), scratch.path() / "estimate.json");
  const Estimate back = ReadEstimate(scratch.path() / "estimate.json");
  EXPECT_EQ(EstimateToJson(back), EstimateToJson(Everything()));
  EXPECT_EQ(back.status, Status::inadequate_model);
  EXPECT_EQ(back.message, "it does not fit") << "the warnings are taken off";
  EXPECT_EQ(back.warnings.size(), 2u);
  EXPECT_EQ(back.Find("coulomb")->interval95->at(1), 15.2);
  EXPECT_TRUE(std::isnan(back.Find("viscous")->value)) << "null";
  EXPECT_EQ(back.Find("gravity"), nullptr);
  EXPECT_EQ(back.holdout->fit, 90);
  EXPECT_EQ(back.gravity->values, (std::vector<double>{0.5, 0.6}));
  EXPECT_EQ(back.bands[0].interval95[1][0], 1.8);
  EXPECT_EQ(back.covariance->matrix[1][0], 0.5);
  EXPECT_EQ(back.diagnostics[0].moves[0].second, 0.4);
  EXPECT_EQ(back.recording->files.size(), 2u);
  EXPECT_EQ(back.recording->read.scale.at("torque"), -0.5);
  EXPECT_EQ(back.recording->read.joint, JointKind::linear);
  EXPECT_EQ(back.recording->prepare.shortest_hold, 3);
  EXPECT_EQ(back.recording->project_file, "warmjoint.yaml");
  EXPECT_EQ(back.recording->project, Everything().recording->project);
  EXPECT_EQ(back.follows->pause, 300);
  EXPECT_EQ(back.follows->energy, (std::vector<double>{-2, -0.5}));
}

TEST(Estimate, NamesItsStatusAsTheContractDoes) {
  EXPECT_EQ(StatusName(Status::ok), "ok");
  EXPECT_EQ(StatusName(Status::not_converged), "not_converged");
  EXPECT_EQ(StatusName(Status::not_identifiable), "not_identifiable");
  EXPECT_EQ(StatusName(Status::inadequate_model), "inadequate_model");
  EXPECT_EQ(StatusName(Status::bad_data), "bad_data");
}

TEST(Estimate, IsRefusedWithThePlace) {
  try {
    EstimateFromJson(R"({"identifier": "x", "status": "fine"})", "mine.json");
    ADD_FAILURE() << "nothing was refused";
  } catch (const BadInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("mine.json"));
    EXPECT_THAT(error.what(), HasSubstr("fine"));
  }
  EXPECT_THROW(ReadEstimate("absent.json"), BadInput);
  EXPECT_THROW(WriteEstimate(Everything(), "absent/estimate.json"), BadInput);
  Estimate torn = Everything();
  torn.covariance->matrix.pop_back();
  EXPECT_THROW(EstimateToJson(torn), BadInput);
  torn = Everything();
  torn.gravity->kind = "none";
  EXPECT_THROW(EstimateToJson(torn), BadInput);
}

}  // namespace
}  // namespace warmjoint::api
