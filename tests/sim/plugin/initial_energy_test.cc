// Joints that start warm: the attribute `initial_energy` in both forms.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/sim/plugin/two_forms.h"

namespace warmjoint {
namespace {

using namespace test;
using ::testing::HasSubstr;

std::string Initial(const std::string& value) {
  return fmt::format(R"(<config key="initial_energy" value="{}"/>)", EscapeXml(value));
}

/// Without ambient, so that a joint at rest only cools, by 3 s.
Friction Warm() { return FrictionsOfEveryLaw()[0]; }

TEST(PluginInitialEnergy, IsWhereTheHeatBeginsAfterEachReset) {
  const std::string more = Initial(R"({"j0": -0.4, "j2": -0.1})");
  for (const Form form : {Form::actuator, Form::passive}) {
    const Model m = MustCompile(ArmXml(Warm(), form, "implicitfast", more));
    m->opt.gravity[2] = 0;
    const Data d(mj_makeData(m.get()));
    for (int round = 0; round < 2; ++round) {
      for (int i = 0; i < 1000; ++i) mj_step(m.get(), d.get());
      const mjtNum* states = form == Form::actuator
                                 ? d->act
                                 : d->plugin_state + m->plugin_stateadr[0] + kFrictionReports;
      // one second of cooling by 3 s, exactly
      EXPECT_NEAR(states[1], -0.4 * std::exp(-1.0 / 3), 1e-12);
      EXPECT_EQ(states[3], 0);
      EXPECT_NEAR(states[5], -0.1 * std::exp(-1.0 / 3), 1e-12);
      mj_resetData(m.get(), d.get());
    }
  }
}

TEST(PluginInitialEnergy, ReachesBothStages) {
  Friction friction = Warm();
  friction.second_thermal = Thermal{-0.01, 0.5};
  for (const Form form : {Form::actuator, Form::passive}) {
    const Model m = MustCompile(ArmXml(friction, form, "RK4", Initial("[-0.3, -0.2]")));
    m->opt.gravity[2] = 0;
    const Data d(mj_makeData(m.get()));
    for (int i = 0; i < 500; ++i) mj_step(m.get(), d.get());
    const mjtNum* states = form == Form::actuator
                               ? d->act
                               : d->plugin_state + m->plugin_stateadr[0] + kFrictionReports;
    EXPECT_NEAR(states[1], -0.3 * std::exp(-0.5 / 3), 1e-12);
    EXPECT_NEAR(states[2], -0.2 * std::exp(-0.5 / 0.5), 1e-12);
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

TEST(PluginInitialEnergy, IsRefusedWithNameAndReason) {
  const auto error = [](const Friction& friction, const std::string& value) {
    return Compile(ArmXml(friction, Form::passive, "Euler", Initial(value))).error;
  };
  EXPECT_THAT(error(Warm(), "x"), HasSubstr("initial_energy is 'x'; it must be a number"));
  EXPECT_THAT(error(Warm(), R"({"j4": 1})"),
              HasSubstr("initial_energy names 'j4', which joints does not"));
  Friction friction = Warm();
  friction.second_thermal = Thermal{-0.01, 0.5};
  EXPECT_THAT(error(friction, "-1"), HasSubstr("give a list of two numbers"));
  friction.thermal.reset();
  friction.second_thermal.reset();
  EXPECT_THAT(error(friction, "-1"), HasSubstr("initial_energy needs thermal"));
}

}  // namespace
}  // namespace warmjoint
