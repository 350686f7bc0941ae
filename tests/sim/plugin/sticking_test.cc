// Joints that stick: the numbers that the plugin promises, and of stiction, Eq. (4).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "tests/sim/plugin/friction_models.h"

namespace warmjoint {
namespace {

using namespace test;

const Config kSixNewtonMetres{{"law", "coulomb"}, {"coulomb", "6"}};

/// Step (s) and integrator.
class Sticking : public testing::TestWithParam<std::tuple<double, const char*>> {
 protected:
  double step() const { return std::get<0>(GetParam()); }
  std::string Option(const char* gravity) const {
    return fmt::format(R"(timestep="{}" integrator="{}" gravity="{}")", step(),
                       std::get<1>(GetParam()), gravity);
  }
  Model Link(const char* gravity) const {
    return MustCompile(LinkXml(FrictionSection(kSixNewtonMetres), Option(gravity)));
  }

  /// How far the bristle of the link, 0.25 kg.m^2, gives way under a load, rad.
  double Elastic(double load) const { return load * step() * step() / (0.64 * 0.25); }
};

TEST_P(Sticking, HoldsALoadBelowItsLevelWithoutCreep) {
  // 1 kg at 0.5 m, level: 4.9 N.m
  const Model m = Link("0 0 -9.81");
  const Data d(mj_makeData(m.get()));
  while (d->time < 2) mj_step(m.get(), d.get());

  const double settled = d->qpos[0];
  EXPECT_LT(std::abs(settled), 1e-3);
  while (d->time < 62) {
    mj_step(m.get(), d.get());
    ASSERT_LT(std::abs(d->qvel[0]), 1e-9);
  }
  EXPECT_LT(std::abs(d->qpos[0] - settled), 1e-6);
}

TEST_P(Sticking, HoldsALoadThatSwingsBelowItsLevelWithoutDrift) {
  const Model m = Link("0 0 0");
  const Data d(mj_makeData(m.get()));
  // 3 N.m and 2.5 N.m of 20 Hz about it: a bristle as in LuGre would ratchet
  const auto shake = [&](double seconds) {
    for (int i = 0; i < std::lround(seconds / step()); ++i) {
      d->qfrc_applied[0] = 3 + 2.5 * std::sin(2 * std::numbers::pi * 20 * d->time);
      mj_step(m.get(), d.get());
    }
  };
  shake(1);
  const double settled = d->qpos[0];
  shake(30);
  // the same phase of the swing; 1e-6 rad/min as at rest
  EXPECT_LT(std::abs(d->qpos[0] - settled), 0.5e-6);
}

TEST_P(Sticking, BreaksAwayWithinAPercentOfItsLevel) {
  for (const int sign : {1, -1}) {
    const Model m = Link("0 0 0");
    const Data d(mj_makeData(m.get()));
    // the load rises by 2 N.m/s, 0.004 N.m in the largest step
    while (sign * d->qpos[0] < 1.05 * Elastic(6)) {
      d->qfrc_applied[0] = sign * 2 * d->time;
      mj_step(m.get(), d.get());
      ASSERT_LT(d->time, 4);
    }
    EXPECT_NEAR(sign * d->qfrc_applied[0], 6, 0.06);
  }
}

TEST_P(Sticking, ReversesWithoutChatter) {
  const Model m = Link("0 0 0");
  const Data d(mj_makeData(m.get()));
  // 12 N.m at 1 Hz: the joint stops, holds and goes back twice a period
  int reversals = 0;
  int direction = 0;
  while (d->time < 5) {
    d->qfrc_applied[0] = 12 * std::sin(2 * std::numbers::pi * d->time);
    mj_step(m.get(), d.get());
    const double v = d->qvel[0];
    if (std::abs(v) < 1e-3 || (v > 0) == (direction > 0)) continue;
    direction = v > 0 ? 1 : -1;
    ++reversals;
  }
  // one direction in each half period, and none besides: it swings back on the bristle by less
  EXPECT_EQ(reversals, 10);
}

constexpr double kCoulomb = 5, kStatic = 8;  // N.m
constexpr double kRate = 2;                  // N.m/s, of the rising load

/// The same of a law with a level at rest of its own, Eq. (4).
class Stiction : public Sticking {
 protected:
  Model Link() const {
    const Config config{{"law", "stiction"}, {"viscous", "0"}, {"coulomb", "5"}, {"static", "8"}};
    return MustCompile(LinkXml(FrictionSection(config, {.states = 3}), Option("0 0 0")));
  }

  /// Raises the load to `sign` until the joint slides; returns it. Slip is the third state.
  double LoadAtBreakAway(const mjModel* m, mjData* d, int sign) const {
    for (int i = 0; d->act[2] == 0; ++i) {
      d->qfrc_applied[0] = sign * kRate * i * step();
      mj_step(m, d);
      if (std::abs(d->qfrc_applied[0]) > 2 * kStatic) break;
    }
    return d->qfrc_applied[0];
  }
};

TEST_P(Stiction, BreaksAwayAtItsStaticLevelThenSlidesAtCoulombs) {
  for (const int sign : {1, -1}) {
    const Model m = Link();
    const Data d(mj_makeData(m.get()));
    // within the 1 % that is promised; the load rises by 0.004 N.m in the largest step
    EXPECT_NEAR(sign * LoadAtBreakAway(m.get(), d.get(), sign), kStatic, 0.01 * kStatic);
    EXPECT_LT(std::abs(d->qpos[0]), 1.1 * Elastic(kStatic));
    EXPECT_EQ(d->act[2], sign);

    // the load stays; from the next step on the force is Coulomb's, and the joint runs away
    for (int i = 0; i < 100; ++i) {
      mj_step(m.get(), d.get());
      ASSERT_EQ(d->actuator_force[0], -sign * kCoulomb) << "step " << i << " of sliding";
    }
    // 3 N.m on 0.25 kg.m^2, after the little speed at break-away
    EXPECT_NEAR(sign * d->qvel[0], (kStatic - kCoulomb) / 0.25 * 100 * step(), 0.1);
  }
}

TEST_P(Stiction, HoldsItsStaticLevelAgainOnceItHasStopped) {
  const Model m = Link();
  const Data d(mj_makeData(m.get()));
  LoadAtBreakAway(m.get(), d.get(), 1);
  for (int i = 0; i < 100; ++i) mj_step(m.get(), d.get());
  ASSERT_GT(d->qvel[0], 0.1);

  // it stops without load, then bears 7.5 N.m, above Coulomb's and below the static level
  d->qfrc_applied[0] = 0;
  const double until = d->time + 3;
  while (d->time < until) mj_step(m.get(), d.get());
  EXPECT_LT(std::abs(d->qvel[0]), 1e-9);
  EXPECT_EQ(d->act[2], 0);
  const double stopped = d->qpos[0];
  for (int i = 0; i * step() < 6; ++i) {
    d->qfrc_applied[0] = std::min(7.5, kRate * i * step());
    mj_step(m.get(), d.get());
    ASSERT_LT(std::abs(d->qpos[0] - stopped), 1.1 * Elastic(kStatic + 7.5));
  }
  EXPECT_LT(std::abs(d->qvel[0]), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(StepsAndIntegrators, Sticking,
                         testing::Combine(testing::Values(0.0005, 0.001, 0.002),
                                          testing::Values("Euler", "implicit", "implicitfast",
                                                          "discrete")),
                         [](const auto& test) {
                           return fmt::format("{}us_{}", std::lround(1e6 * std::get<0>(test.param)),
                                              std::get<1>(test.param));
                         });

INSTANTIATE_TEST_SUITE_P(StepsAndIntegrators, Stiction,
                         testing::Combine(testing::Values(0.0005, 0.001, 0.002),
                                          testing::Values("Euler", "implicitfast", "discrete")));

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

}  // namespace
}  // namespace warmjoint
