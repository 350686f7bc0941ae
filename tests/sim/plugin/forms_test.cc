// The passive form beside the actuator form: same motion, same sensors; the robot's own numbers, prefixes, sleep.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/sim/plugin/two_forms.h"

namespace warmjoint {
namespace {

using namespace test;

/// Largest difference of two arms' positions over two seconds in surroundings 10 K warmer, rad.
double Difference(const Model& a, const Model& b) {
  const Data da(mj_makeData(a.get())), db(mj_makeData(b.get()));
  SetAmbient(a.get(), da.get(), Form::actuator, 10);
  SetAmbient(b.get(), db.get(), Form::passive, 10);
  double worst = 0;
  while (da->time < 2) {
    DriveArm(a.get(), da.get(), 1);
    DriveArm(b.get(), db.get(), 1);
    for (int k = 0; k < kArmJoints; ++k) {
      worst = std::max(worst, std::abs(da->qpos[k] - db->qpos[k]));
    }
  }
  // warm, and the same states in the same order
  EXPECT_LT(da->act[1], -0.001);
  for (int k = 0; k < a->na; ++k) {
    EXPECT_NEAR(da->act[k], StatesOf(b.get(), db.get())[k], 1e-9);
  }
  return worst;
}

constexpr const char* kIntegrators[] = {"Euler", "implicit", "implicitfast", "discrete", "RK4"};

TEST(PluginForms, MoveAlikeWithEveryLawAndIntegrator) {
  for (const Friction& friction : FrictionsOfEveryLaw()) {
    for (const char* integrator : kIntegrators) {
      const Model a = MustCompile(ArmXml(friction, Form::actuator, integrator));
      const Model b = MustCompile(ArmXml(friction, Form::passive, integrator));
      // the forces are summed in another order; joints near a reversal amplify the last bit
      EXPECT_LT(Difference(a, b), 1e-11) << friction.law << " " << integrator;
    }
  }
}

TEST(PluginPassive, LeavesTheMotorsForcesAndALimitOfThemAsTheyWere) {
  std::string xml = ArmXml(FrictionsOfEveryLaw()[0], Form::passive, "implicitfast");
  xml.insert(xml.find("axis="), R"(actuatorfrcrange="-1 1" )");
  const Model m = MustCompile(xml);
  const Data d(mj_makeData(m.get()));
  DriveArm(m.get(), d.get(), 300);
  mj_forward(m.get(), d.get());
  EXPECT_GT(d->ctrl[0], 1);
  // the motors alone are in qfrc_actuator
  for (int k = 0; k < kArmJoints; ++k) {
    EXPECT_EQ(d->qfrc_actuator[k], k == 0 ? 1 : d->ctrl[k]);
    EXPECT_NE(d->qfrc_passive[k], -0.2 * d->qvel[k]);
  }
}

TEST(PluginSensors, ReadWhatTheFrictionDoes) {
  for (const Form form : {Form::actuator, Form::passive}) {
    const Model m = MustCompile(SensedArmXml(FrictionsOfEveryLaw()[1], form));
    ASSERT_EQ(m->nsensordata, kSensed * kArmJoints);
    const Data d(mj_makeData(m.get()));
    int held = 0, slid = 0;
    for (int i = 0; i < 1500; ++i) {
      DriveArm(m.get(), d.get(), 1);
      mj_forward(m.get(), d.get());
      const mjtNum* all = d->sensordata;
      const mjtNum* states = StatesOf(m.get(), d.get());
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

TEST(PluginSensors, OfAJointReadThatJoint) {
  const std::string config = R"(<config key="instance" value="arm"/>)";
  for (const Form form : {Form::actuator, Form::passive}) {
    const std::string whole = SensedArmXml(FrictionsOfEveryLaw()[1], form);
    std::string single = SensedArmXml(FrictionsOfEveryLaw()[1], form,
                                      R"(objtype="joint" objname="j1" cutoff="0.5")");
    single.insert(single.find(config), R"(<config key="joint_sensors" value="true"/>)");
    const Model a = MustCompile(whole), b = MustCompile(single);
    ASSERT_EQ(b->nsensordata, kSensed);
    const Data c(mj_makeData(a.get())), d(mj_makeData(b.get()));
    DriveArm(a.get(), c.get(), 300);
    DriveArm(b.get(), d.get(), 300);
    const mjtNum* of_joint = c->sensordata + kSensed;
    EXPECT_GT(std::abs(of_joint[0]), 0.5);
    for (int i = 0; i < kSensed; ++i) {
      EXPECT_EQ(d->sensordata[i], std::clamp(of_joint[i], -0.5, 0.5));
    }
  }
}

/// A link that 6 N.m of friction hold against 4.9 N.m of weight, warm at the start.
constexpr char kLink[] = R"(
<mujoco>
  <extension><plugin plugin="warmjoint.friction"><instance name="f">
    <config key="joints" value='{"hinge": {"law": "coulomb", "parameters": {"coulomb": 6},
      "thermal": {"thermal_gain": -0.3, "thermal_time_constant": 2}}}'/>
    <config key="initial_energy" value="-0.5"/>
  </instance></plugin></extension>
  <option timestep="0.002"><flag sleep="enable" contact="disable"/></option>
  <worldbody><body>
    <joint name="hinge" axis="0 1 0"/>
    <inertial pos="0.5 0 0" mass="1" diaginertia="1e-9 1e-9 1e-9"/>
  </body></worldbody>
</mujoco>)";

TEST(PluginSleep, CoolsOnAndWakesWhereItWas) {
  const Model m = MustCompile(kLink);
  const Data d(mj_makeData(m.get()));
  const mjtNum* energy = StatesOf(m.get(), d.get()) + 1;
  while (d->tree_asleep[0] < 0 && d->time < 5) mj_step(m.get(), d.get());
  ASSERT_GE(d->tree_asleep[0], 0) << "never slept";
  const double position = d->qpos[0], force = d->qfrc_passive[0];
  const double warm = *energy, began = d->time;

  const double until = d->time + 3;
  while (d->time < until) mj_step(m.get(), d.get());
  EXPECT_GE(d->tree_asleep[0], 0);
  EXPECT_EQ(d->qpos[0], position);
  EXPECT_EQ(d->qfrc_passive[0], force);
  EXPECT_LT(warm, -0.1);
  EXPECT_NEAR(*energy, warm * std::exp(-(d->time - began) / 2), 1e-12);

  // a load below the level wakes it, and moves it by no more than its bristle gives
  d->qfrc_applied[0] = -4;
  for (int i = 0; i < 500; ++i) mj_step(m.get(), d.get());
  EXPECT_LT(d->tree_asleep[0], 0);
  // it slept at a speed within the engine's tolerance, not quite at rest
  EXPECT_NEAR(d->qpos[0], position - 4 * 4e-6 / (0.64 * 0.25), 1e-8);
}

}  // namespace
}  // namespace warmjoint
