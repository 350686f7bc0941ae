#include "sim/plugin/friction_instance.h"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "tests/sim/plugin/friction_models.h"

namespace warmjoint {
namespace {

using namespace test;

const Config kTable1{{"law", "viscous_coulomb"},
                     {"viscous", "5"},
                     {"coulomb", "15"},
                     {"thermal_gain", "-3"},
                     {"thermal_time_constant", "600"}};

TEST(PluginHeat, FollowsTheClosedFormAtConstantSpeedAtAnyStep) {
  const double v = 0.5, k = -3, tau = 600, level = 5 * v + 15;
  for (const double h : {0.0005, 0.002, 0.02}) {
    const Model m =
        MustCompile(LinkXml(FrictionSection(kTable1),
                            fmt::format(R"(timestep="{}" gravity="0 0 0")", h), R"(armature="2")"));
    const Data d(mj_makeData(m.get()));
    const double cooling = -std::expm1(-h / tau);  // 1 - te
    const double settled = k * v * level / (1 - k * v);
    const double rate = cooling * (1 - k * v);  // 1 - (te + ke v)
    d->act[0] = 15;                             // slides from the first step on

    for (int i = 1; i <= 20000; ++i) {
      d->qvel[0] = v;
      mj_step(m.get(), d.get());
      if (i % 5000 != 0) continue;
      const double closed = settled * -std::expm1(i * std::log1p(-rate));
      // the last bit of te is 1e-16, which is 1e-10 of 1 - te at the smallest step
      EXPECT_NEAR(d->act[1], closed, 1e-9 * std::abs(closed)) << "step " << h;

      // the continuous form differs by h (1 - k v) / (2 tau) of the rate
      const double continuous = settled * -std::expm1(-i * h * (1 - k * v) / tau);
      EXPECT_NEAR(d->act[1], continuous, 2 * h / tau * std::abs(settled));
    }
  }
}

TEST(PluginViscous, MovesAsNativeDampingDoes) {
  const Model ours = MustCompile(
      LinkXml(FrictionSection({{"law", "viscous_coulomb"}, {"viscous", "2"}, {"coulomb", "0"}}),
              kNoGravity));
  const Model native = MustCompile(LinkXml("", kNoGravity, R"(damping="2")"));
  const Data a(mj_makeData(ours.get())), b(mj_makeData(native.get()));
  a->qvel[0] = b->qvel[0] = 3;
  for (int i = 0; i < 1000; ++i) {
    mj_step(ours.get(), a.get());
    mj_step(native.get(), b.get());
    // both explicit (eulerdamp off): rounding alone
    ASSERT_NEAR(a->qvel[0], b->qvel[0], 1e-13);
    ASSERT_NEAR(a->qpos[0], b->qpos[0], 1e-12);
  }
}

TEST(PluginCoulomb, SlidesAsFrictionlossDoes) {
  const Model ours =
      MustCompile(LinkXml(FrictionSection({{"law", "coulomb"}, {"coulomb", "6"}}), kNoGravity));
  const Model native = MustCompile(LinkXml("", kNoGravity, R"(frictionloss="6")"));
  const Data a(mj_makeData(ours.get())), b(mj_makeData(native.get()));
  a->qvel[0] = b->qvel[0] = 30;
  // 24 rad/s^2 stop the joint after 1.25 s; until 1.2 s it slides
  for (int i = 0; i < 1200; ++i) {
    mj_step(ours.get(), a.get());
    mj_step(native.get(), b.get());
    // a saturated frictionloss is the same number: rounding of 30 rad/s in 1200 steps
    ASSERT_NEAR(a->qvel[0], b->qvel[0], 5e-12);
  }
}

TEST(PluginAtRest, DoesNotChatter) {
  const Model m = MustCompile(
      LinkXml(FrictionSection({{"law", "coulomb"}, {"coulomb", "6"}}), R"(timestep="0.001")"));
  const Data d(mj_makeData(m.get()));
  d->qvel[0] = 2;
  while (d->time < 2) mj_step(m.get(), d.get());

  // the weight asks 4.9 N.m of 6: the link stopped where it is and stays
  const double stopped = d->qpos[0];
  EXPECT_GT(stopped, 0.1);
  for (int i = 0; i < 2000; ++i) {
    mj_step(m.get(), d.get());
    ASSERT_LT(std::abs(d->qvel[0]), 1e-9);
  }
  EXPECT_NEAR(d->qpos[0], stopped, 1e-12);
}

/// A warm joint in motion: steps it with a swinging drive.
void Drive(const mjModel* m, mjData* d, int steps) {
  for (int i = 0; i < steps; ++i) {
    d->qfrc_applied[0] = 30 * std::sin(3 * d->time);
    mj_step(m, d);
  }
}

std::vector<mjtNum> StateOf(const mjModel* m, const mjData* d) {
  std::vector<mjtNum> state(mj_stateSize(m, mjSTATE_INTEGRATION));
  mj_getState(m, d, state.data(), mjSTATE_INTEGRATION);
  return state;
}

TEST(PluginState, ContinuesBitForBitFromACopyAndFromAStateVector) {
  const Model m = MustCompile(LinkXml(FrictionSection(kTable1), R"(timestep="0.001")"));
  const Data d(mj_makeData(m.get())), restored(mj_makeData(m.get()));
  Drive(m.get(), d.get(), 700);

  const Data copy(mj_copyData(nullptr, m.get(), d.get()));
  const std::vector<mjtNum> state = StateOf(m.get(), d.get());
  mj_setState(m.get(), restored.get(), state.data(), mjSTATE_INTEGRATION);

  Drive(m.get(), d.get(), 700);
  Drive(m.get(), copy.get(), 700);
  Drive(m.get(), restored.get(), 700);
  EXPECT_LT(d->act[1], 0) << "the joint should be warm";
  EXPECT_EQ(StateOf(m.get(), copy.get()), StateOf(m.get(), d.get()));
  EXPECT_EQ(StateOf(m.get(), restored.get()), StateOf(m.get(), d.get()));
}

TEST(PluginState, StartsWarmFromAKeyframeAndColdFromAReset) {
  const Model m = MustCompile(
      LinkXml(FrictionSection(kTable1) + R"(<keyframe><key name="warm" act="0 -9"/></keyframe>)",
              kNoGravity));
  const Data d(mj_makeData(m.get()));
  mj_resetDataKeyframe(m.get(), d.get(), 0);
  d->qvel[0] = 1;
  mj_forward(m.get(), d.get());
  // sliding at once would need a loaded bristle: 5 v + min(15 - 9, bristle of one step)
  EXPECT_EQ(d->act[1], -9);
  EXPECT_DOUBLE_EQ(d->actuator_force[0], -(5 + 15 - 9));

  mj_resetData(m.get(), d.get());
  EXPECT_EQ(d->act[1], 0);
}

}  // namespace
}  // namespace warmjoint
