// Break-away of stiction, Eq. (4): a static level held at rest, Coulomb's while sliding.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "tests/sim/plugin/friction_models.h"

namespace warmjoint {
namespace {

using namespace test;

constexpr double kCoulomb = 5, kStatic = 8;  // N.m
constexpr double kRate = 2;                  // N.m/s, of the rising load

/// Step (s) and integrator.
class Stiction : public testing::TestWithParam<std::tuple<double, const char*>> {
 protected:
  double step() const { return std::get<0>(GetParam()); }

  /// How far the bristle of the link, 0.25 kg.m^2, gives way under a load, rad.
  double Elastic(double load) const { return load * step() * step() / (0.8 * 0.25); }

  Model Link() const {
    const Config config{{"law", "stiction"}, {"viscous", "0"}, {"coulomb", "5"}, {"static", "8"}};
    return MustCompile(LinkXml(FrictionSection(config, {.states = 3}),
                               fmt::format(R"(timestep="{}" integrator="{}" gravity="0 0 0")",
                                           step(), std::get<1>(GetParam()))));
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

INSTANTIATE_TEST_SUITE_P(StepsAndIntegrators, Stiction,
                         testing::Combine(testing::Values(0.0005, 0.001, 0.002),
                                          testing::Values("Euler", "implicitfast", "discrete")));

}  // namespace
}  // namespace warmjoint
