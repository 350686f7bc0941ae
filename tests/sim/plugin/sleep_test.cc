// The passive form lets trees sleep: they cool on, and wake where they were.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sim/plugin/friction_instance.h"
#include "tests/sim/plugin/friction_models.h"

namespace warmjoint {
namespace {

using namespace test;

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
  const mjtNum* energy = d->plugin_state + m->plugin_stateadr[0] + kFrictionReports + 1;
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
  EXPECT_NEAR(d->qpos[0], position - 4 * 4e-6 / (0.8 * 0.25), 1e-8);
}

}  // namespace
}  // namespace warmjoint
