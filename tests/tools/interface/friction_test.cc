#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/friction.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "models/robots/robot_folder.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint::api {
namespace {

using testing::HasSubstr;

/// Table I of the paper.
Friction TableOne() {
  Friction friction;
  friction.parameters = {{"viscous", 5}, {"coulomb", 15}};
  friction.thermal = Thermal{-3, 600};
  return friction;
}

TEST(FrictionModel, GivesTheClosedFormOfItsLawAndHeat) {
  const FrictionModel model(TableOne());
  // kv v + sign(v) (kc + E)
  EXPECT_DOUBLE_EQ(model.Force(0.5), 2.5 + 15);
  EXPECT_DOUBLE_EQ(model.Force(-0.5), -2.5 - 15);
  JointPlace warm;
  warm.energy = -6;
  EXPECT_DOUBLE_EQ(model.Force(0.5, warm), 2.5 + 15 - 6);
  EXPECT_EQ(model.Force(0), 0);
  EXPECT_DOUBLE_EQ(model.HoldingLevel(), 15);
}

TEST(FrictionModel, WarmsByTheExactZeroOrderHoldAlongAMotion) {
  Motion motion;
  for (int i = 0; i < 50; ++i) {
    motion.time.push_back(60 * i);
    motion.velocity.push_back(0.3);
  }
  const FrictionCourse course = FrictionModel(TableOne()).Along(motion, -1);
  // Eq. (22): te = exp(-h / tau), ke = k (1 - te); W = |F v|
  const double te = std::exp(-0.1), ke = -3 * (1 - te);
  double energy = -1;
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_NEAR(course.energy[i], energy, 1e-12) << "a sum of 50 roundings";
    EXPECT_NEAR(course.force[i], 1.5 + 15 + energy, 1e-12);
    EXPECT_NEAR(course.loss[i], (1.5 + 15 + energy) * 0.3, 1e-12);
    energy = te * energy + ke * (1.5 + 15 + energy) * 0.3;
  }
  EXPECT_NEAR(course.end.energy, course.energy.back(), 1e-12);
  // E = k |v| F0 / (1 - k |v|), at which it settles
  EXPECT_NEAR(SettledEnergy(TableOne(), 0.3)->at(0), -0.9 * 16.5 / 1.9, 1e-9);
}

TEST(FrictionModel, TakesLoadAmbientPositionAndStartsOfAMotion) {
  Friction friction = TableOne();
  friction.load_gain = 0.1;
  friction.level_per_temperature = -0.05;
  // one plain kernel of 2 N.m at 1 rad
  friction.maps = {{{{"position", {1}, 0.5, {}, false}}, false, "one", {2}}};
  Motion motion;
  motion.time = {0, 60, 120};
  motion.velocity = {0.5, 0.5, 0.5};
  motion.position = {1, 1, 1.5};
  motion.load = {0, -20, 0};
  motion.ambient_rise = {10, 10, 10};
  motion.starts = {2};
  const FrictionCourse course = FrictionModel(friction).Along(motion);
  EXPECT_DOUBLE_EQ(course.force[0], 2.5 + 15 + 2);
  // Eq. (22) with (1 - te) kT (Ts - T0) of the ambient
  const double te = std::exp(-0.1);
  const double energy = (1 - te) * (-3 * (2.5 + 15 + 2) * 0.5 - 0.05 * 10);
  EXPECT_NEAR(course.energy[1], energy, 1e-12);
  EXPECT_NEAR(course.force[1], 2.5 + 15 + 2 + 0.1 * 20 + energy, 1e-12);
  // cold again; one width from the kernel's centre
  EXPECT_EQ(course.energy[2], 0);
  EXPECT_NEAR(course.force[2], 2.5 + 15 + 2 * std::exp(-0.5), 1e-12);

  JointPlace place;
  place.position = 1.5;
  place.load = 20;
  EXPECT_NEAR(FrictionModel(friction).Force(0.5, place), 2.5 + 15 + 2 * std::exp(-0.5) + 2, 1e-12);
}

TEST(FrictionModel, StepsAsThePluginDoes) {
  const double h = 0.002;
  const FrictionModel model(TableOne(), h);
  FrictionState state;
  double energy = 0;
  for (int i = 0; i < 1000; ++i) {
    const FrictionStep step = model.Step(state, {0, 0.5, 1, 0, 0});
    energy = std::exp(-h / 600) * energy - 3 * -std::expm1(-h / 600) * step.loss;
    state = step.next;
  }
  EXPECT_NEAR(state.energy, energy, 1e-12);
  // it slides: the force is that of the place
  JointPlace place;
  place.energy = state.energy;
  EXPECT_NEAR(model.Step(state, {0, 0.5, 1, 0, 0}).force, model.Force(0.5, place), 1e-9);
}

TEST(Friction, ReadsBackWithAllItsParts) {
  Friction friction = TableOne();
  friction.second_thermal = Thermal{-1, 60};
  friction.gear = 100;
  friction.load_gain = 0.1;
  friction.ambient = 25;
  friction.level_per_temperature = -0.05;
  friction.viscous_per_energy = 0.02;
  friction.maps = {{{{"motor_position", {0, 1, 2, 3}, 1, 2 * std::acos(-1.0), false},
                     {"velocity", {-0.5, 0.5}, 0.5, {}, true}},
                    false,
                    "direction",
                    {1, 2, 3, 4, 5, 6, 7, 8}}};
  const std::string json = FrictionToJson(friction);
  const Friction back = FrictionFromJson(json);
  EXPECT_EQ(FrictionToJson(back), json);
  ASSERT_EQ(back.maps.size(), 1u);
  EXPECT_EQ(back.maps[0].axes[1].quantity, "velocity");
  EXPECT_TRUE(back.maps[0].axes[1].sides_apart);
  EXPECT_FALSE(back.maps[0].normalised);
  EXPECT_EQ(back.maps[0].weights, friction.maps[0].weights);
  EXPECT_EQ(back.maps[0].factor, "direction");
  EXPECT_DOUBLE_EQ(*back.maps[0].axes[0].period, 2 * std::acos(-1.0));
  EXPECT_EQ(back.parameters, friction.parameters);
  EXPECT_EQ(back.thermal->gain, -3);
  EXPECT_EQ(back.second_thermal->time_constant, 60);
  EXPECT_EQ(back.ambient, 25);
  EXPECT_EQ(back.gear, 100);
  EXPECT_EQ(back.level_per_temperature, -0.05);
  EXPECT_EQ(back.viscous_per_energy, 0.02);
  EXPECT_EQ(back.load_gain, 0.1);

  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "friction.json", json);
  EXPECT_EQ(FrictionToJson(ReadFriction(scratch.path() / "friction.json")), json);
  const auto robot = DataFolder() / "models/robots/rotary/friction.json";
  EXPECT_EQ(ReadFriction(robot).parameters.at("coulomb"), 15) << "Table I";
}

TEST(Friction, IsRefusedWithBoundOrNearestName) {
  const auto refusal = [](auto change) {
    Friction friction = TableOne();
    change(friction);
    try {
      CheckFriction(friction);
    } catch (const BadInput& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal([](Friction&) {}), "");
  EXPECT_THAT(refusal([](Friction& f) { f.law = "coulom"; }), HasSubstr("'coulomb'"));
  EXPECT_THAT(refusal([](Friction& f) { f.parameters["coulomb"] = -1; }), HasSubstr("coulomb"));
  EXPECT_THAT(refusal([](Friction& f) { f.thermal->time_constant = 0; }), HasSubstr("thermal"));
  EXPECT_THAT(refusal([](Friction& f) {
                f.maps = {{{{"positon", {0}}}, true, "one", {1}}};
              }),
              HasSubstr("'position'"));
  EXPECT_THROW(FrictionFromJson("{"), BadInput);
  EXPECT_THROW(ReadFriction("absent.json"), BadInput);
  EXPECT_THROW(FrictionModel(TableOne(), 0), BadInput);
  Motion uneven;
  uneven.time = {0, 1};
  uneven.velocity = {1};
  EXPECT_THROW(FrictionModel(TableOne()).Along(uneven), BadInput);
  uneven.velocity = {1, 1};
  uneven.time = {0, 0};
  EXPECT_THROW(FrictionModel(TableOne()).Along(uneven), BadInput);
}

TEST(Laws, AreThoseOfTheCommand) {
  const auto listed = nlohmann::json::parse(RunWarmjoint({"list", "laws", "--format", "json"}).out);
  const std::vector<LawInfo> laws = Laws();
  EXPECT_GE(laws.size(), 5u);
  // the command tells of what joins a law behind them
  ASSERT_LE(laws.size(), listed.size());
  for (std::size_t i = 0; i < laws.size(); ++i) {
    EXPECT_EQ(nlohmann::json(laws[i].name), listed[i].at("name"));
    EXPECT_EQ(nlohmann::json(laws[i].equation), listed[i].at("equation"));
    ASSERT_EQ(laws[i].parameters.size(), listed[i].at("parameters").size());
    for (std::size_t k = 0; k < laws[i].parameters.size(); ++k) {
      const ParameterInfo& info = laws[i].parameters[k];
      const auto& row = listed[i]["parameters"][k];
      EXPECT_EQ(nlohmann::json(info.name), row.at("name"));
      EXPECT_EQ(nlohmann::json(info.symbol), row.at("symbol"));
      EXPECT_EQ(nlohmann::json(info.rotary_unit), row.at("unit").at("rotary"));
      EXPECT_EQ(nlohmann::json(info.linear_unit), row.at("unit").at("linear"));
      EXPECT_EQ(nlohmann::json(info.default_value), row.at("default"));
      EXPECT_EQ(nlohmann::json(info.meaning), row.at("meaning"));
      EXPECT_EQ(std::isfinite(info.upper), !row.at("upper").is_null());
    }
  }
}

}  // namespace
}  // namespace warmjoint::api
