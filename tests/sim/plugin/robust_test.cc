// What a running simulation may do to the plugin: numbers that are none, a step set anew.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "tests/sim/plugin/two_forms.h"

namespace warmjoint {
namespace {

using namespace test;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class PluginNan : public testing::TestWithParam<Form> {
 protected:
  PluginNan() : m(MustCompile(ArmXml(FrictionsOfEveryLaw()[1], GetParam(), "implicitfast"))) {}

  mjtNum* States(mjData* d) const { return StatesOf(m.get(), d); }

  Warnings warnings;  // the engine's own, of controls that are no numbers
  Model m;
};

TEST_P(PluginNan, InTheAmbientLastsOneStep) {
  const Data d(mj_makeData(m.get())), without(mj_makeData(m.get()));
  SetAmbient(m.get(), d.get(), GetParam(), kNan);
  mj_step(m.get(), d.get());
  mj_step(m.get(), without.get());
  SetAmbient(m.get(), d.get(), GetParam(), 0);
  DriveArm(m.get(), d.get(), 300);
  DriveArm(m.get(), without.get(), 300);
  EXPECT_EQ(FullState(m.get(), d.get()), FullState(m.get(), without.get()));
}

TEST_P(PluginNan, InOneStateInTheMidstOfARunCountsAsZero) {
  for (int k = 0; k < 2 * kArmJoints; ++k) {
    const Data d(mj_makeData(m.get()));
    DriveArm(m.get(), d.get(), 300);
    const Data zero(mj_copyData(nullptr, m.get(), d.get()));
    States(d.get())[k] = kNan;
    States(zero.get())[k] = 0;
    mj_step(m.get(), d.get());
    mj_step(m.get(), zero.get());
    // the engine adds h act_dot to what stands in act, which rounds, and the plugin writes beside it
    for (int i = 0; i < 2 * kArmJoints; ++i) {
      EXPECT_NEAR(States(d.get())[i], States(zero.get())[i], 1e-15) << k << ", " << i;
    }
    for (int i = 0; i < m->nv; ++i) EXPECT_EQ(d->qvel[i], zero->qvel[i]);
  }
}

INSTANTIATE_TEST_SUITE_P(Forms, PluginNan, testing::Values(Form::actuator, Form::passive));

TEST(PluginGroups, SwitchedOffInTheMidstOfARunKeepTheirStatesAndGoOn) {
  for (const char* integrator : {"Euler", "implicitfast", "RK4"}) {
    const Model m = MustCompile(ArmXml(FrictionsOfEveryLaw()[1], Form::actuator, integrator));
    // the second joint's friction has a group of its own
    m->actuator_group[kArmJoints + 1] = 3;
    const Data d(mj_makeData(m.get()));
    DriveArm(m.get(), d.get(), 300);
    const std::vector<mjtNum> before(d->act, d->act + m->na);

    m->opt.disableactuator = 1 << 3;
    DriveArm(m.get(), d.get(), 100);
    for (int joint = 0; joint < kArmJoints; ++joint) {
      const bool off = joint == 1;
      EXPECT_EQ(d->actuator_force[kArmJoints + joint] == 0, off) << integrator << joint;
      EXPECT_EQ(d->act[2 * joint] == before[2 * joint], off) << integrator << joint;
      EXPECT_EQ(d->act[2 * joint + 1] == before[2 * joint + 1], off) << integrator << joint;
    }

    // goes on as data that never was switched off, from the state that it has now
    const std::vector<mjtNum> state = FullState(m.get(), d.get());
    m->opt.disableactuator = 0;
    DriveArm(m.get(), d.get(), 100);
    const Data fresh(mj_makeData(m.get()));
    mj_setState(m.get(), fresh.get(), state.data(), mjSTATE_FULLPHYSICS);
    DriveArm(m.get(), fresh.get(), 100);
    EXPECT_EQ(FullState(m.get(), fresh.get()), FullState(m.get(), d.get())) << integrator;
  }
}

TEST(PluginTimestep, RaisedBeyondWhatTheFrictionBearsWarnsOnce) {
  for (const Form form : {Form::actuator, Form::passive}) {
    const Model m = MustCompile(ArmXml(FrictionsOfEveryLaw()[0], form, "implicitfast"));
    const Data d(mj_makeData(m.get()));
    const mjtNum* report = d->plugin_state + m->plugin_stateadr[0] + kReportsStep;
    const Warnings warnings;
    m->opt.timestep = 0.002;
    DriveArm(m.get(), d.get(), 2);
    EXPECT_EQ(Warnings::text(), "");
    m->opt.timestep = 0.5;
    mj_step(m.get(), d.get());
    EXPECT_EQ(*report, 1);
    EXPECT_THAT(Warnings::text(), testing::HasSubstr("at timestep 0.5;"));
    EXPECT_THAT(Warnings::text(), testing::HasSubstr("take a timestep of at most"));
    const std::string once = Warnings::text();
    m->opt.timestep = 0.6;
    mj_step(m.get(), d.get());
    EXPECT_EQ(Warnings::text(), once);
  }
}

}  // namespace
}  // namespace warmjoint
