// Sensors of the plugin: force, energy, temperature, loss, held.
#include <gmock/gmock.h>

#include "sim/plugin/bound_joints.h"
#include "tests/sim/plugin/two_forms.h"

namespace warmjoint {
namespace {

using namespace test;

std::string Sensed(Form form, const std::string& object = "") {
  return SensedArmXml(FrictionsOfEveryLaw()[1], form, object);
}

TEST(PluginSensors, ReadWhatTheFrictionDoes) {
  for (const Form form : {Form::actuator, Form::passive}) {
    const Model m = MustCompile(Sensed(form));
    ASSERT_EQ(m->nsensordata, kSensed * kArmJoints);
    const Data d(mj_makeData(m.get()));
    int held = 0, slid = 0;
    for (int i = 0; i < 1500; ++i) {
      DriveArm(m.get(), d.get(), 1);
      mj_forward(m.get(), d.get());
      const mjtNum* all = d->sensordata;
      const mjtNum* states = form == Form::actuator
                                 ? d->act
                                 : d->plugin_state + m->plugin_stateadr[0] + kFrictionReports;
      for (int k = 0; k < kArmJoints; ++k, all += kSensed) {
        if (form == Form::actuator) {
          EXPECT_EQ(all[0], d->actuator_force[kArmJoints + k]);
        }
        EXPECT_EQ(all[1], states[2 * k + 1]);
        EXPECT_DOUBLE_EQ(all[2], all[1] / -0.02);  // level_per_temperature
        if (all[4] == 0) {
          EXPECT_DOUBLE_EQ(all[3], std::abs(all[0] * d->qvel[k]));
          ++slid;
        } else {
          ++held;
        }
      }
    }
    EXPECT_GT(held, 10);
    EXPECT_GT(slid, 10);
  }
}

TEST(PluginSensors, ThatNameAnObjectAreRefused) {
  EXPECT_THAT(Compile(Sensed(Form::passive, R"(objtype="joint" objname="j1")")).error,
              testing::HasSubstr("sensor 's': names an object"));
}

}  // namespace
}  // namespace warmjoint
