// warmjoint export --to ros2, ur and fmu: what a controller and a simulator read, against the friction that it is of.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <nlohmann/json.hpp>

#include "models/foundation/bad_input.h"
#include "tests/support/refusal.h"
#include "tools/export/controller_text.h"
#include "tools/export/engine_text.h"
#include "tools/export/fmu_text.h"

namespace warmjoint {
namespace {

SeenFriction Joint(const std::string& name, double coulomb = 15) {
  Friction friction;
  friction.law = "viscous_coulomb";
  friction.parameters = {{"viscous", 5}, {"coulomb", coulomb}};
  friction.thermal = Thermal{-0.75, 600};
  return {.joint = name, .friction = friction, .intervals = {{"coulomb", {14.5, 15.5}}}};
}

/// A UR's six joints, not in its order.
std::vector<SeenFriction> Ur() {
  std::vector<SeenFriction> joints;
  for (const char* name : {"wrist_3_joint", "wrist_2_joint", "wrist_1_joint", "elbow_joint",
                           "shoulder_lift_joint", "shoulder_pan_joint"}) {
    joints.push_back(Joint(std::string("left_") + name, 10 + static_cast<double>(joints.size())));
  }
  return joints;
}

TEST(Ros2, HoldsTheNumbersOfEachJointAsDoubles) {
  const std::vector<SeenFriction> joints{Joint("shoulder"), Joint("elbow: 2", 4e-7)};
  const std::string text = RosText(joints);
  const YAML::Node read = YAML::Load(text)["friction_compensation_controller"]["ros__parameters"];
  ASSERT_EQ(read["joints"].as<std::vector<std::string>>(),
            (std::vector<std::string>{"shoulder", "elbow: 2"}));
  for (const SeenFriction& seen : joints) {
    const CompensatorNumbers held(seen.friction, seen.doubt);
    const YAML::Node told = read["friction"][seen.joint];
    EXPECT_EQ(told["viscous"].as<double>(), 5);
    EXPECT_EQ(told["coulomb_positive"].as<double>(), held.numbers().coulomb_positive);
    EXPECT_EQ(told["thermal_gain"].as<double>(), -0.75);
    EXPECT_EQ(told["thermal_time_constant"].as<double>(), 600);
    // a whole number would be an integer to ROS 2, and 4e-07 a text to a reader of YAML 1.1
    for (const auto& one : told) {
      EXPECT_THAT(one.second.Scalar(), testing::HasSubstr(".")) << one.first.Scalar();
    }
  }
  EXPECT_THAT(text, testing::HasSubstr("14.5 .. 15.5 N.m"));
}

TEST(Ros2, RefusesByNameWhatParametersDoNotHold) {
  SeenFriction mapped = Joint("elbow");
  mapped.friction.maps = {
      {.axes = {{MapQuantity::position, EvenAxis(-1, 1, 3)}}, .weights = {1, -2, 1}}};
  EXPECT_THAT(test::RefusalOf([&] { RosText({mapped}); }),
              testing::AllOf(testing::HasSubstr("elbow"), testing::HasSubstr("position"),
                             testing::HasSubstr("--to cpp")));
  EXPECT_THAT(test::RefusalOf([&] { RosText({Joint("arm.elbow")}); }),
              testing::HasSubstr("arm.elbow"));
}

TEST(Ur, ScalesItsOwnCompensationByWhatTheHeatLeaves) {
  for (const double share : {0.0, 1.0}) {
    const YAML::Node read = YAML::Load(UrText(Ur(), {share, 0.5}))["parameters"];
    const auto viscous = read["viscous_scale"].as<std::vector<double>>();
    const auto coulomb = read["coulomb_scale"].as<std::vector<double>>();
    ASSERT_EQ(viscous.size(), 6u);
    ASSERT_EQ(coulomb.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
      // the i-th of the arm stands last but i in the file, with that much Coulomb friction more; E settled at 0.5 rad/s
      const double cold = 10 + static_cast<double>(5 - i);
      const double energy = share * -0.375 * (cold + 2.5) / 1.375;
      EXPECT_NEAR(viscous[i], kUrViscousShares[i], 5e-4);
      EXPECT_NEAR(coulomb[i], kUrCoulombShares[i] * (cold + energy) / cold, 5e-4) << i;
    }
  }
}

TEST(Ur, RefusesByNameWhatItDoesNotTake) {
  std::vector<SeenFriction> joints = Ur();
  joints[3].friction.thermal->gain = 0.9;
  EXPECT_THAT(
      test::RefusalOf([&] {
        UrText(joints, {1, 0.5});
      }),
      testing::AllOf(testing::HasSubstr("left_elbow_joint"), testing::HasSubstr("Coulomb")));
  joints.erase(joints.begin() + 1);
  EXPECT_THAT(test::RefusalOf([&] { UrText(joints, {}); }), testing::HasSubstr("wrist_2_joint"));
  joints = Ur();
  joints.push_back(Joint("gripper"));
  EXPECT_THAT(test::RefusalOf([&] { UrText(joints, {}); }), testing::HasSubstr("7 joints"));
}

TEST(Fmu, DescribesEachJointOnce) {
  const FmuFiles one = FmuFilesOf({Joint("elbow")}),
                 two = FmuFilesOf({Joint("a"), Joint("b\"\n\x01")});
  EXPECT_EQ(one.model, "elbow_friction");
  EXPECT_EQ(one.files.size(), 5u);
  const std::string& description = two.files.at("modelDescription.xml");
  EXPECT_THAT(description, testing::HasSubstr("name=\"a.velocity\""));
  EXPECT_THAT(description, testing::HasSubstr("name=\"b&quot;"));
  EXPECT_THAT(description, testing::Not(testing::HasSubstr("\x01")));
  EXPECT_THAT(description, testing::HasSubstr("95 %: 14.5 .. 15.5 N.m"));
  // another friction is another model, which an importer tells by its token
  EXPECT_NE(FmuFilesOf({Joint("elbow", 14)}).files.at("sources/friction.h"),
            one.files.at("sources/friction.h"));
  EXPECT_THAT(test::RefusalOf([&] {
                FmuFilesOf({Joint("a-1"), Joint("a_1")});
              }),
              testing::HasSubstr("a_1_friction"));
}

TEST(Controllers, TakeAWarmthWhereHeatIsNoState) {
  const Node friction(
      nlohmann::json{{"law", "viscous_coulomb"}, {"parameters", {{"viscous", 5}, {"coulomb", 15}}}},
      "friction.json");
  for (const EngineFormat to : {EngineFormat::ros2, EngineFormat::fmu}) {
    EXPECT_THAT(test::RefusalOf([&] {
                  ExportFrictions(friction, {.to = to, .warmth = {1, {}}, .joint = "elbow"});
                }),
                testing::HasSubstr("--warm"));
  }
  EXPECT_THAT(test::RefusalOf([&] { ExportFrictions(friction, {.to = EngineFormat::ros2}); }),
              testing::HasSubstr("--joint NAME"));
}

}  // namespace
}  // namespace warmjoint
