// Integrators: RK4 asks four times a step, and one may be set after the model was loaded.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/sim/plugin/two_forms.h"

namespace warmjoint {
namespace {

using namespace test;

const Config kHolding{
    {"law", "coulomb"}, {"coulomb", "10"}, {"thermal_gain", "-3"}, {"thermal_time_constant", "20"}};

void Steps(const mjModel* m, mjData* d, int n) {
  for (int i = 0; i < n; ++i) mj_step(m, d);
}

TEST(PluginIntegrator, HoldsAndWarmsUnderRk4WhenSetAtLoadOrLater) {
  // 4.9 N.m of gravity on a joint that holds 10
  const Model held = MustCompile(LinkXml(FrictionSection(kHolding), R"(timestep="0.001")"));
  const Data d(mj_makeData(held.get()));
  Steps(held.get(), d.get(), 100);
  held->opt.integrator = mjINT_RK4;
  d->act[1] = -2;
  Steps(held.get(), d.get(), 3000);
  const double settled = d->qpos[0];
  Steps(held.get(), d.get(), 10000);
  EXPECT_LT(std::abs(d->qpos[0] - settled), 1e-9);
  // 13 s of cooling by 20 s
  EXPECT_NEAR(d->act[1], -2 * std::exp(-13.0 / 20), 1e-9);
}

TEST(PluginIntegrator, SlidesUnderRk4AsFrictionlossDoes) {
  const char* option = R"(timestep="0.001" integrator="RK4" gravity="0 0 0")";
  const Model ours =
      MustCompile(LinkXml(FrictionSection({{"law", "coulomb"}, {"coulomb", "6"}}), option));
  const Data d(mj_makeData(ours.get()));
  d->qvel[0] = 30;
  Steps(ours.get(), d.get(), 1);
  // 6 N.m on 0.25 kg.m^2 and the inertial's 1e-9
  const double start = d->qvel[0];
  Steps(ours.get(), d.get(), 1000);
  EXPECT_NEAR(d->qvel[0], start - 6 / (0.25 + 1e-9), 1e-10);
}

}  // namespace
}  // namespace warmjoint
