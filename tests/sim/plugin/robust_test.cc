// What a running simulation may do to the plugin: numbers that are none, a step set anew.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "tests/sim/plugin/two_forms.h"
#include "tests/sim/plugin/warnings.h"

namespace warmjoint {
namespace {

using namespace test;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class PluginNan : public testing::TestWithParam<Form> {
 protected:
  PluginNan() : m(MustCompile(ArmXml(FrictionsOfEveryLaw()[1], GetParam(), "implicitfast"))) {}

  /// The states of the joints, [2 x joints].
  mjtNum* States(mjData* d) const {
    if (GetParam() == Form::actuator) return d->act;
    return d->plugin_state + m->plugin_stateadr[0] + kFrictionReports;
  }

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

TEST_P(PluginNan, InAStateLastsOneStep) {
  const Data d(mj_makeData(m.get()));
  for (int k = 0; k < 2 * kArmJoints; ++k) States(d.get())[k] = k % 2 == 0 ? kNan : -kNan;
  mj_step(m.get(), d.get());
  for (int k = 0; k < 2 * kArmJoints; ++k) EXPECT_TRUE(std::isfinite(States(d.get())[k])) << k;
  DriveArm(m.get(), d.get(), 300);
  EXPECT_LT(States(d.get())[1], 0);
}

INSTANTIATE_TEST_SUITE_P(Forms, PluginNan, testing::Values(Form::actuator, Form::passive));

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
