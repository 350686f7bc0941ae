// An integrator that is set after the model was loaded.
#include <gmock/gmock.h>

#include <cmath>

#include "sim/plugin/friction_instance.h"
#include "tests/sim/plugin/friction_models.h"
#include "tests/sim/plugin/warnings.h"

namespace warmjoint {
namespace {

using namespace test;

const Config kHolding{
    {"law", "coulomb"}, {"coulomb", "10"}, {"thermal_gain", "-3"}, {"thermal_time_constant", "20"}};

void Steps(const mjModel* m, mjData* d, int n) {
  for (int i = 0; i < n; ++i) mj_step(m, d);
}

TEST(PluginIntegrator, GivesNoFrictionUnderRk4AndSaysSoOnce) {
  // 4.9 N.m of gravity on a joint that holds 10
  const Model held = MustCompile(LinkXml(FrictionSection(kHolding), R"(timestep="0.001")"));
  const Model bare = MustCompile(LinkXml("", R"(timestep="0.001" integrator="RK4")"));
  const Data d(mj_makeData(held.get())), falling(mj_makeData(bare.get()));
  const mjtNum* report = d->plugin_state + held->plugin_stateadr[0] + kReportsIntegrator;
  d->act[1] = -2;
  Steps(held.get(), d.get(), 100);
  EXPECT_EQ(*report, 0);
  const double load = d->act[0], energy = d->act[1];

  // from the same place the joint falls as one without friction, and keeps its states
  const Warnings warnings;
  held->opt.integrator = mjINT_RK4;
  falling->qpos[0] = d->qpos[0];
  falling->qvel[0] = d->qvel[0];
  Steps(held.get(), d.get(), 200);
  Steps(bare.get(), falling.get(), 200);
  EXPECT_GT(d->qpos[0], 0.1);
  EXPECT_EQ(d->qpos[0], falling->qpos[0]);
  EXPECT_EQ(d->act[0], load);
  EXPECT_EQ(d->act[1], energy);
  EXPECT_EQ(*report, 1);
  EXPECT_THAT(Warnings::text(), testing::HasSubstr("integrator was set to RK4"));
  const std::string once = Warnings::text();
  Steps(held.get(), d.get(), 10);
  EXPECT_EQ(Warnings::text(), once);

  // and there is friction again under another
  held->opt.integrator = mjINT_IMPLICITFAST;
  const double speed = d->qvel[0];
  Steps(held.get(), d.get(), 500);
  EXPECT_LT(std::abs(d->qvel[0]), 0.1 * std::abs(speed));
  mj_resetData(held.get(), d.get());
  EXPECT_EQ(*report, 0);
}

}  // namespace
}  // namespace warmjoint
