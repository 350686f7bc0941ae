// Friction of a linear joint, in N and m: sticking, break-away, warm-up, limits.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/sim/plugin/friction_models.h"

namespace warmjoint {
namespace {

using namespace test;
using ::testing::AllOf;
using ::testing::HasSubstr;

const Config kFortyNewton{{"law", "coulomb"}, {"coulomb", "40"}};
constexpr char kSlideGravity[] = R"(timestep="0.001" integrator="implicitfast")";
constexpr char kFree[] = R"(timestep="0.001" integrator="implicitfast" gravity="0 0 0")";

Model Carriage(const Config& config, const std::string& option) {
  return MustCompile(CarriageXml(FrictionSection(config, {.joint = "slide"}), option));
}

TEST(PluginCarriage, SticksUnderItsWeight) {
  // 3 kg weigh 29.4 N of 40
  const Model m = Carriage(kFortyNewton, kSlideGravity);
  const Data d(mj_makeData(m.get()));
  while (d->time < 2) mj_step(m.get(), d.get());
  const double settled = d->qpos[0];
  // the bristle gives way by 29.4 N h^2 / (0.8 M), and yields by less than the first step's fall
  const double give = 29.43e-6 / (0.8 * 3);
  EXPECT_GT(-settled, give - 1e-12);
  EXPECT_LT(-settled, give + 9.81e-6);
  while (d->time < 62) {
    mj_step(m.get(), d.get());
    ASSERT_LT(std::abs(d->qvel[0]), 1e-9);
  }
  EXPECT_LT(std::abs(d->qpos[0] - settled), 1e-6);
}

TEST(PluginCarriage, BreaksAwayWithinAPercentOfItsLevel) {
  const Model m = Carriage(kFortyNewton, kFree);
  const Data d(mj_makeData(m.get()));
  while (d->qpos[0] < 1.05 * 40e-6 / (0.8 * 3) && d->time < 9) {
    d->qfrc_applied[0] = 5 * d->time;
    mj_step(m.get(), d.get());
  }
  EXPECT_NEAR(d->qfrc_applied[0], 40, 0.4);
}

TEST(PluginCarriage, WarmsByTheClosedForm) {
  // W = |F v| in W of N and m/s: E settles at k v F0 / (1 - k v), N
  const double v = 0.2, k = -0.8, tau = 300, level = 60 * v + 40, h = 0.001;
  const Model m = Carriage({{"law", "viscous_coulomb"},
                            {"viscous", "60"},
                            {"coulomb", "40"},
                            {"thermal_gain", "-0.8"},
                            {"thermal_time_constant", "300"}},
                           kFree);
  const Data d(mj_makeData(m.get()));
  d->act[0] = 40;  // slides from the first step on
  const double settled = k * v * level / (1 - k * v), rate = -std::expm1(-h / tau) * (1 - k * v);
  for (int i = 1; i <= 20000; ++i) {
    d->qvel[0] = v;
    mj_step(m.get(), d.get());
    if (i % 5000 != 0) continue;
    const double closed = settled * -std::expm1(i * std::log1p(-rate));
    // the last bit of te is 1e-16, which is 3e-11 of 1 - te
    EXPECT_NEAR(d->act[1], closed, 1e-9 * std::abs(closed)) << "step " << i;
    EXPECT_NEAR(d->actuator_force[0], -(level + closed), 1e-4 * level);
  }
}

TEST(PluginCarriage, IsRefusedWhereItWouldGiveWayTooFar) {
  // 32 kN on 3 kg at 1 ms: 32000 N h^2 / (0.8 M) = 13 mm
  const auto error = [](const Config& config) {
    return Compile(CarriageXml(FrictionSection(config, {.joint = "slide"}), kFree)).error;
  };
  EXPECT_THAT(error({{"law", "coulomb"}, {"coulomb", "32000"}}),
              AllOf(HasSubstr("give way by 0.0133 m"), HasSubstr("at most 0.005"),
                    HasSubstr("armature of 5.05"), HasSubstr("timestep of at most 0.000612")));
}

}  // namespace
}  // namespace warmjoint
