// warmjoint export: the numbers of other engines, against the friction that they are of.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <urdf_parser/urdf_parser.h>
#include <warmjoint/friction_model.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "models/foundation/bad_input.h"
#include "tests/support/refusal.h"
#include "tools/export/engine_text.h"
#include "tools/export/native_text.h"

namespace warmjoint {
namespace {

const Thermal kHeat{-3, 600};

Friction WarmLine() {
  return {
      .law = "viscous_coulomb", .parameters = {{"viscous", 5}, {"coulomb", 15}}, .thermal = kHeat};
}

Friction Cold(const char* law, const std::map<std::string, double>& parameters) {
  Friction friction;
  friction.law = law;
  friction.parameters = parameters;
  return friction;
}

double PercentOf(const EngineFriction& found, std::string_view what) {
  for (const Omission& one : found.left_out) {
    if (one.what == what && one.percent) return *one.percent;
  }
  return 0;
}

class EachEngine : public testing::TestWithParam<EngineFormat> {};

TEST_P(EachEngine, SaysAStraightLineExactlyAtEveryWarmth) {
  const SeenFriction seen{.joint = "elbow", .friction = WarmLine()};
  const FrictionModel model(seen.friction);
  for (const double warm : {0.0, 0.4, 1.0}) {
    const EngineFriction found = InEngine(seen, {warm, 0.5}, GetParam());
    EXPECT_NEAR(found.energy, warm * SettledEnergy(seen.friction, 0.5)->at(0), 1e-12);
    for (const double v : {0.06, 0.5, 0.97}) {
      const double told = found.viscous * v + found.level;
      EXPECT_NEAR(told, model.Force(v, {.energy = found.energy}), 1e-9) << warm << " at " << v;
      EXPECT_NEAR(-told, model.Force(-v, {.energy = found.energy}), 1e-9);
    }
    EXPECT_NEAR(found.static_level, found.level, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Export, EachEngine,
                         testing::Values(EngineFormat::mjcf, EngineFormat::urdf,
                                         EngineFormat::physx, EngineFormat::isaaclab,
                                         EngineFormat::mjlab),
                         [](const auto& tested) { return std::string(NameOf(tested.param)); });

TEST(Export, UrdfdomReadsWhatUrdfSays) {
  const SeenFriction seen{.joint = "el<bow", .friction = WarmLine()};
  const FrictionModel model(seen.friction);
  for (const double warm : {0.0, 1.0}) {
    const EngineFriction told = InEngine(seen, {warm, 0.5}, EngineFormat::urdf);
    std::string text = EngineText({told}, EngineFormat::urdf);
    text.insert(text.find("<dynamics"), "<parent link=\"base\"/><child link=\"lower\"/>");
    text.insert(text.find("name=\"el"), "type=\"continuous\" ");
    const auto robot = urdf::parseURDF(
        "<robot name=\"arm\"><link name=\"base\"/><link name=\"lower\"/>" + text + "</robot>");
    ASSERT_TRUE(robot) << text;
    const auto dynamics = robot->getJoint("el<bow")->dynamics;
    ASSERT_TRUE(dynamics);
    for (const double v : {0.15, 0.4, 0.9}) {
      EXPECT_NEAR(dynamics->damping * v + dynamics->friction,
                  model.Force(v, {.energy = told.energy}), 1e-6);
    }
  }
}

TEST(Export, SaysByHowMuchDirectionsDiffer) {
  const SeenFriction seen{
      .joint = "elbow",
      .friction =
          Cold("asymmetric", {{"viscous", 0}, {"coulomb_positive", 6}, {"coulomb_negative", 4}})};
  const EngineFriction found = InEngine(seen, {}, EngineFormat::mjcf);
  EXPECT_NEAR(found.level, 5, 1e-12);
  // 1 N.m of 5
  EXPECT_NEAR(PercentOf(found, "asymmetry"), 20, 1e-9);
  EXPECT_EQ(PercentOf(found, "speed"), 0);
}

TEST(Export, SaysByHowMuchHeatChangesIt) {
  // settled at 0.1 rad/s: E = k |v| F / (1 - k |v|) = -0.3 * 15.5 / 1.3
  const SeenFriction seen{.joint = "elbow", .friction = WarmLine(), .speeds = {0.1, 0.1}};
  const EngineFriction found = InEngine(seen, {}, EngineFormat::urdf);
  EXPECT_NEAR(PercentOf(found, "heat"), 100 * -0.3 / 1.3, 1e-9);
  // of one speed alone the slope is the law's
  EXPECT_NEAR(found.viscous, 5, 1e-12);
}

TEST(Export, KeepsALevelAtRestWhereTheEngineHasOne) {
  const SeenFriction seen{
      .joint = "elbow",
      .friction = Cold("stiction", {{"viscous", 1}, {"coulomb", 4}, {"static", 6}})};
  EXPECT_NEAR(InEngine(seen, {}, EngineFormat::physx).static_level, 6, 1e-12);
  EXPECT_EQ(PercentOf(InEngine(seen, {}, EngineFormat::physx), "rest"), 0);
  EXPECT_GT(PercentOf(InEngine(seen, {}, EngineFormat::mjcf), "rest"), 30);
}

TEST(Export, CountsWhatAPlaceAdds) {
  SeenFriction seen{.joint = "elbow", .friction = WarmLine()};
  seen.friction.maps = {{.axes = {{MapQuantity::motor_position, CircleAxis(6.283185307179586, 4)}},
                         .weights = {2, 0, -2, 0},
                         .factor = MapFactor::direction}};
  seen.friction.gear = 100;
  const EngineFriction found = InEngine(seen, {}, EngineFormat::mjcf);
  // at most the weights, less what neighbouring kernels take away
  EXPECT_GT(PercentOf(found, "position"), 100 * 0.5 / 21);
  EXPECT_LT(PercentOf(found, "position"), 100 * 2.0 / 15);
  EXPECT_NEAR(found.level, 15, 0.01);
}

TEST(Export, WritesTheDigitsThatTheIntervalSupports) {
  const std::map<std::string, double> parameters{{"viscous", 0.123456789}, {"coulomb", 0.654321}};
  SeenFriction seen{
      .joint = "elbow", .friction = Cold("viscous_coulomb", parameters), .speeds = {1, 10}};
  // without an interval twelve digits at most
  EXPECT_THAT(EngineText({InEngine(seen, {}, EngineFormat::mjcf)}, EngineFormat::mjcf),
              testing::HasSubstr(R"(damping="0.123456789" frictionloss="0.654321")"));
  // half a width of 0.034: the level by 0.001, viscous by a tenth of that at 10 rad/s
  seen.half_width = 0.034;
  EXPECT_THAT(EngineText({InEngine(seen, {}, EngineFormat::mjcf)}, EngineFormat::mjcf),
              testing::HasSubstr(R"(damping="0.1235" frictionloss="0.654")"));
  EXPECT_NEAR(InEngine(seen, {}, EngineFormat::mjcf).viscous, 0.123456789, 1e-12);
}

TEST(Export, WritesSpringsWithAYieldForAnInertiaAndAStep) {
  SeenFriction seen{.joint = "elbow", .friction = WarmLine()};
  // cold, and as stiff as a step of 1 ms carries beside the other joints of an arm
  const auto text = [&](double timestep) {
    return NativeText({InEngine(seen, {}, EngineFormat::mjcf)}, timestep);
  };
  EXPECT_THAT(test::RefusalOf([&] { text(0.001); }), testing::HasSubstr("--as native"));
  seen.inertia = 3.3;
  EXPECT_THAT(
      text(0.001),
      testing::HasSubstr(R"(name="elbow" stiffness="1e+06" springyield="1.5e-05" damping="5")"));
  EXPECT_THAT(test::RefusalOf([&] { text(0.1); }), testing::HasSubstr("--timestep 0.05"));
  seen.friction.parameters["viscous"] = 0.1;
  EXPECT_THAT(test::RefusalOf([&] { text(0.001); }), testing::HasSubstr("1.5 or more"));
  // what a spring holds does not creep
  const Node friction(
      nlohmann::json{{"law", "viscous_coulomb"}, {"parameters", {{"viscous", 5}, {"coulomb", 15}}}},
      "friction.json");
  const Exported exported = ExportFrictions(friction, {.native = true});
  EXPECT_THAT(exported.frictions.front().left_out, testing::IsEmpty());
  EXPECT_THAT(test::RefusalOf(
                  [&] { ExportFrictions(friction, {.to = EngineFormat::urdf, .native = true}); }),
              testing::HasSubstr("--native"));
}

TEST(Export, AsksForANameWhereTheEngineFindsJointsByIt) {
  const Node friction(nlohmann::json{{"law", "coulomb"}, {"parameters", {{"coulomb", 2}}}},
                      "friction.json");
  for (const EngineFormat to : {EngineFormat::physx, EngineFormat::isaaclab, EngineFormat::mjlab}) {
    EXPECT_THAT(test::RefusalOf([&] { ExportFrictions(friction, {.to = to}); }),
                testing::HasSubstr("--joint NAME"));
  }
  for (const EngineFormat to : {EngineFormat::mjcf, EngineFormat::urdf}) {
    const std::string text = EngineText(ExportFrictions(friction, {.to = to}).frictions, to);
    EXPECT_THAT(text, testing::Not(testing::HasSubstr("name=")));
    EXPECT_THAT(text, testing::HasSubstr("=\"2\"/>"));
  }
}

TEST(Export, RefusesWhatHasNoAnswer) {
  const SeenFriction seen{.joint = "elbow", .friction = WarmLine()};
  EXPECT_THAT(test::RefusalOf([&] {
                InEngine(seen, {-1, 0.5}, EngineFormat::mjcf);
              }),
              testing::HasSubstr("--warm"));
  EXPECT_THAT(test::RefusalOf([&] {
                InEngine(seen, {1, 0.0}, EngineFormat::mjcf);
              }),
              testing::HasSubstr("--speed"));
  SeenFriction heats = seen;
  heats.friction.thermal->gain = 3;
  EXPECT_THAT(test::RefusalOf([&] {
                InEngine(heats, {1, 0.5}, EngineFormat::mjcf);
              }),
              testing::HasSubstr("never settles"));
  const Node nothing(
      nlohmann::json{{"joints", nlohmann::json::object()}, {"summary", nlohmann::json::object()}},
      "robot.json");
  EXPECT_THAT(test::RefusalOf([&] { ExportFrictions(nothing, {}); }),
              testing::HasSubstr("holds no friction"));
}

}  // namespace
}  // namespace warmjoint
