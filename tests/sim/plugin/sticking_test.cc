// Joints that stick: the numbers that the plugin promises.
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
  Model Link(const char* gravity) const {
    const std::string option = fmt::format(R"(timestep="{}" integrator="{}" gravity="{}")", step(),
                                           std::get<1>(GetParam()), gravity);
    return MustCompile(LinkXml(FrictionSection(kSixNewtonMetres), option));
  }
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
    const double elastic = 6 * step() * step() / (0.8 * 0.25);
    while (sign * d->qpos[0] < 1.05 * elastic) {
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

INSTANTIATE_TEST_SUITE_P(StepsAndIntegrators, Sticking,
                         testing::Combine(testing::Values(0.0005, 0.001, 0.002),
                                          testing::Values("Euler", "implicit", "implicitfast",
                                                          "discrete")),
                         [](const auto& test) {
                           return fmt::format("{}us_{}", std::lround(1e6 * std::get<0>(test.param)),
                                              std::get<1>(test.param));
                         });

}  // namespace
}  // namespace warmjoint
