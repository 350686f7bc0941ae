// Heat of surroundings, of two stages and at a start, and friction that drives the joint.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "models/foundation/bad_input.h"
#include "models/foundation/xml_tags.h"
#include "models/friction/friction_json.h"
#include "sim/plugin/bound_joints.h"
#include "sim/plugin/friction_instance.h"
#include "tests/sim/plugin/two_forms.h"

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

  // ignored where no temperature form is given
  Config config = kThermometer;
  config.erase("level_per_temperature");
  const Model plain = MustCompile(LinkXml(FrictionSection(config), kNoGravity));
  const Data e(mj_makeData(plain.get()));
  e->ctrl[0] = 15;
  for (int i = 0; i < 100; ++i) mj_step(plain.get(), e.get());
  EXPECT_EQ(e->act[1], 0);
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

  const mjtNum* states = StatesOf(m.get(), d.get());
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

std::string Initial(const std::string& value) {
  return fmt::format(R"(<config key="initial_energy" value="{}"/>)", EscapeXml(value));
}

/// Without ambient, so that a joint at rest only cools, by 3 s.
Friction Warm() { return FrictionsOfEveryLaw()[0]; }

TEST(PluginInitialEnergy, IsWhereTheHeatOfEachStageBeginsAfterEachReset) {
  Friction two_stages = Warm();
  two_stages.second_thermal = Thermal{-0.01, 0.5};
  const struct {
    Friction friction;
    const char* initial;
    std::vector<std::array<double, 2>> energies;  // {E, tau} of each of a joint's stages
  } cases[] = {{Warm(), R"({"j0": -0.4, "j2": -0.1})", {{-0.4, 3}, {0, 3}, {-0.1, 3}}},
               {two_stages, "[-0.3, -0.2]", {{-0.3, 3}, {-0.2, 0.5}}}};
  for (const auto& [friction, initial, energies] : cases) {
    const bool two = friction.second_thermal.has_value();
    for (const Form form : {Form::actuator, Form::passive}) {
      const Model m = MustCompile(ArmXml(friction, form, two ? "RK4" : "Euler", Initial(initial)));
      m->opt.gravity[2] = 0;
      const Data d(mj_makeData(m.get()));
      for (int round = 0; round < 2; ++round) {
        for (int i = 0; i < 1000; ++i) mj_step(m.get(), d.get());
        // one second of cooling, exactly; the bristle's load stands before the energies
        for (size_t k = 0; k < energies.size(); ++k) {
          const double energy = StatesOf(m.get(), d.get())[two ? 1 + k : 1 + 2 * k];
          EXPECT_NEAR(energy, energies[k][0] * std::exp(-1 / energies[k][1]), 1e-12);
        }
        mj_resetData(m.get(), d.get());
      }
    }
  }
}

TEST(PluginInitialEnergy, MovesBothFormsAlikeAndContinuesBitForBit) {
  const std::string more = Initial("-0.3");
  const Model a = MustCompile(ArmXml(Warm(), Form::actuator, "implicitfast", more));
  const Model b = MustCompile(ArmXml(Warm(), Form::passive, "implicitfast", more));
  const Data da(mj_makeData(a.get())), db(mj_makeData(b.get()));
  DriveArm(a.get(), da.get(), 1);
  DriveArm(b.get(), db.get(), 1);
  for (int k = 0; k < kArmJoints; ++k) EXPECT_NEAR(da->qvel[k], db->qvel[k], 1e-14);

  // a state vector from before the first step starts warm, too
  const Data fresh(mj_makeData(a.get())), other(mj_makeData(a.get()));
  const std::vector<mjtNum> start = FullState(a.get(), fresh.get());
  DriveArm(a.get(), other.get(), 77);
  mj_setState(a.get(), other.get(), start.data(), mjSTATE_FULLPHYSICS);
  DriveArm(a.get(), other.get(), 1);
  EXPECT_EQ(FullState(a.get(), other.get()), FullState(a.get(), da.get()));
}

TEST(PluginInitialEnergy, IsOverruledByAKeyframesAct) {
  std::string xml = ArmXml(Warm(), Form::actuator, "implicitfast", Initial("-0.3"));
  xml.insert(xml.rfind("</mujoco>"), R"(<keyframe><key act="0 -9 0 -8 0 -7"/></keyframe>)");
  const Model m = MustCompile(xml);
  const Data d(mj_makeData(m.get()));
  mj_resetDataKeyframe(m.get(), d.get(), 0);
  mj_step(m.get(), d.get());
  EXPECT_NEAR(d->act[1], -9 * std::exp(-0.001 / 3), 1e-12);
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
