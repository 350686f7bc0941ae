// Heat of surroundings and of two stages in the engine, and friction that feeds itself.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "models/foundation/bad_input.h"
#include "models/friction/check_friction.h"
#include "sim/plugin/bound_joints.h"
#include "sim/plugin/friction_instance.h"
#include "tests/sim/plugin/two_forms.h"
#include "tests/sim/plugin/warnings.h"

namespace warmjoint {
namespace {

using namespace test;

const Config kThermometer{{"law", "coulomb"},
                          {"coulomb", "10"},
                          {"thermal_gain", "-3"},
                          {"thermal_time_constant", "20"},
                          {"level_per_temperature", "-0.2"}};

TEST(PluginAmbient, IsTheControlAndMovesTheLevelOfAJointAtRest) {
  const Model m = MustCompile(LinkXml(FrictionSection(kThermometer), kNoGravity));
  const Data d(mj_makeData(m.get()));
  // 15 K above the temperature of the parameters for 30 s, then back: (17) with W = 0
  const auto rest = [&](double rise, double seconds) {
    d->ctrl[0] = rise;
    for (int i = 0; i < std::lround(1000 * seconds); ++i) mj_step(m.get(), d.get());
  };
  rest(15, 30);
  const double warm = -0.2 * 15 * -std::expm1(-30.0 / 20);
  // 1e-16 of te against 1 - te = 5e-5, over 3e4 steps
  EXPECT_NEAR(d->act[1], warm, 1e-10);
  rest(0, 10);
  EXPECT_NEAR(d->act[1], warm * std::exp(-10.0 / 20), 1e-10);
}

TEST(PluginAmbient, IsIgnoredWhereNoTemperatureFormIsGiven) {
  Config config = kThermometer;
  config.erase("level_per_temperature");
  const Model m = MustCompile(LinkXml(FrictionSection(config), kNoGravity));
  const Data d(mj_makeData(m.get()));
  d->ctrl[0] = 15;
  for (int i = 0; i < 100; ++i) mj_step(m.get(), d.get());
  EXPECT_EQ(d->act[1], 0);
}

TEST(PluginHeat, HasTwoStagesThatSettleEachAtItsGain) {
  Config config = kThermometer;
  config["second_thermal_gain"] = "-0.5";
  config["second_thermal_time_constant"] = "2";
  const Model m =
      MustCompile(LinkXml(FrictionSection(config, {.states = 3}), kNoGravity, R"(armature="2")"));
  const Data d(mj_makeData(m.get()));
  d->act[0] = 10;
  const double v = 0.1, h = 0.001;

  // the same two recursions by hand: W = v (10 + E1 + E2)
  double first = 0, second = 0;
  for (int i = 0; i < 20000; ++i) {
    const double loss = v * (10 + first + second);
    first = std::exp(-h / 20) * first - 3 * -std::expm1(-h / 20) * loss;
    second = std::exp(-h / 2) * second - 0.5 * -std::expm1(-h / 2) * loss;
    d->qvel[0] = v;
    mj_step(m.get(), d.get());
  }
  // rounding of 2e4 steps
  EXPECT_NEAR(d->act[1], first, 1e-11);
  EXPECT_NEAR(d->act[2], second, 1e-11);
}

TEST(PluginHeat, StartsWarmInBothStagesFromAKeyframe) {
  Config config = kThermometer;
  config["second_thermal_gain"] = "-0.5";
  config["second_thermal_time_constant"] = "2";
  const Model m = MustCompile(LinkXml(
      FrictionSection(config, {.states = 3}) + R"(<keyframe><key act="0 -4 -3"/></keyframe>)",
      kNoGravity));
  const Data d(mj_makeData(m.get()));
  mj_resetDataKeyframe(m.get(), d.get(), 0);

  // at rest each stage cools by its own time constant; rounding of 5000 steps
  for (int i = 0; i < 5000; ++i) mj_step(m.get(), d.get());
  EXPECT_NEAR(d->act[1], -4 * std::exp(-5.0 / 20), 1e-11);
  EXPECT_NEAR(d->act[2], -3 * std::exp(-5.0 / 2), 1e-11);

  // sliding at once, the level is lower by both: 10 - 4 - 3
  mj_resetDataKeyframe(m.get(), d.get(), 0);
  d->qvel[0] = 1;
  mj_forward(m.get(), d.get());
  EXPECT_DOUBLE_EQ(d->actuator_force[0], -(10 - 4 - 3));
}

/// Friction with each number beside the law and the first stage by itself, and with all of them.
std::vector<Friction> HeatedInEveryWay() {
  Friction plain = FrictionsOfEveryLaw()[1];
  for (const FrictionOption& option : FrictionOptions()) plain.*option.value = 0;
  std::vector<Friction> all{plain};
  Friction rich = plain;
  rich.second_thermal = Thermal{-0.01, 0.5};
  for (const FrictionOption& option : FrictionOptions()) {
    // of the sign that is allowed beside the gain
    Friction one = plain;
    for (const double value : {0.02, -0.02}) {
      one.*option.value = value;
      try {
        CheckFriction(one, {"a test"});
        break;
      } catch (const BadInput&) {
      }
    }
    all.push_back(one);
    rich.*option.value = one.*option.value;
  }
  all.push_back(rich);
  return all;
}

/// Steps an arm that slides, is held and stands still, and holds its energies to Heat.
void ExpectHeat(const Friction& friction, Form form) {
  const Model m = MustCompile(SensedArmXml(friction, form));
  const Data d(mj_makeData(m.get()));
  JointFriction joint(friction);
  joint.SetTimestep(m->opt.timestep);
  const size_t count = joint.state().size();

  const mjtNum* states =
      form == Form::actuator ? d->act : d->plugin_state + m->plugin_stateadr[0] + kFrictionReports;
  const auto energies = [&](size_t k) { return joint.Load(states + count * k); };
  int held = 0, slid = 0;
  for (int i = 0; i < 1500; ++i) {
    // at last exactly at rest, as no engine leaves a joint
    if (i > 1200) std::fill_n(d->qvel, m->nv, 0.0);
    // what the step that follows is to make of both stages
    mj_forward(m.get(), d.get());
    std::array<std::array<double, 2>, kArmJoints> next;
    for (size_t k = 0; k < kArmJoints; ++k) {
      const mjtNum* sensed = d->sensordata + kSensed * k;
      const FrictionState now = energies(k);
      const Heating by{sensed[3], 0, d->qvel[k]};
      next[k] = {joint.heat().First(now.energy, by), joint.heat().Second(now.second_energy, by)};
      ++(sensed[4] == 0 ? slid : held);
    }
    DriveArm(m.get(), d.get(), 1);
    for (size_t k = 0; k < kArmJoints; ++k) {
      EXPECT_DOUBLE_EQ(energies(k).energy, next[k][0]) << i << " of joint " << k;
      EXPECT_DOUBLE_EQ(energies(k).second_energy, next[k][1]) << i << " of joint " << k;
    }
  }
  EXPECT_GT(held, 10);
  EXPECT_GT(slid, 10);
}

TEST(PluginHeat, IsThatOfHeatWhateverNumbersShapeIt) {
  for (const Friction& friction : HeatedInEveryWay()) {
    for (const Form form : {Form::actuator, Form::passive}) ExpectHeat(friction, form);
  }
}

TEST(PluginReport, TellsOnceWhereFrictionWouldFeedItself) {
  // Table I, long above 1 rad/s and then slow: E = -3 v F0 / (1 + 3 v) exceeds 15 in size
  const Config config{{"law", "viscous_coulomb"},
                      {"viscous", "5"},
                      {"coulomb", "15"},
                      {"thermal_gain", "-3"},
                      {"thermal_time_constant", "1"}};
  const Model m = MustCompile(LinkXml(FrictionSection(config), kNoGravity, R"(armature="9")"));
  const Data d(mj_makeData(m.get()));
  const mjtNum* report = d->plugin_state + m->plugin_stateadr[0] + kReportsPush;
  const Warnings warnings;
  const auto slide = [&](double v, int steps) {
    for (int i = 0; i < steps; ++i) {
      d->qvel[0] = v;
      mj_step(m.get(), d.get());
    }
  };
  slide(4, 5000);
  EXPECT_EQ(*report, 0);
  EXPECT_LT(d->act[1], -15);
  slide(0.05, 100);
  EXPECT_EQ(*report, 1);
  EXPECT_EQ(d->actuator_force[0], 0) << "it must not push";
  const std::string once = Warnings::text();
  EXPECT_THAT(once, testing::AllOf(testing::HasSubstr("actuator 'f'"), testing::HasSubstr("at 5")));
  slide(0.05, 100);
  EXPECT_EQ(Warnings::text(), once);

  mj_resetData(m.get(), d.get());
  EXPECT_EQ(*report, 0);
}

}  // namespace
}  // namespace warmjoint
