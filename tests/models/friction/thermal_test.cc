#include "models/friction/thermal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/shared_data.h"

namespace warmjoint {
namespace {

// closed forms hold to 1e-12 relative (golden/README)
constexpr double kClosedForm = 1e-12;

void ExpectClose(double value, double expected) {
  EXPECT_NEAR(value, expected, kClosedForm * std::abs(expected));
}

/// E over time at a constant speed, by Eqs. (19)-(22). nominal: Fn, N.m; feedback: whether W sees
/// E.
struct ConstantSpeed {
  double speed;
  double nominal;
  DiscreteThermal thermal;

  double Energy(int steps) const {
    double energy = 0;
    for (int i = 0; i < steps; ++i) {
      const double loss = Loss(speed, WarmForce(speed, nominal, energy));
      energy = ThermalStep(thermal.gain, thermal.pole, energy, loss);
    }
    return energy;
  }
};

TEST(Thermal, DiscretisesAsTheGoldenPairs) {
  const auto& golden = test::Golden()["c2d"];
  const auto check = [](const nlohmann::json& inp, double ke, double te) {
    const DiscreteThermal pair = Discretise({inp["kbar"], inp["tbar"]}, inp["h"]);
    ExpectClose(pair.gain, ke);
    ExpectClose(pair.pole, te);
  };
  check(golden["inp"], golden["ke"], golden["te"]);
  check(golden["yumi"]["inp"], golden["yumi"]["ke"], golden["yumi"]["te"]);
}

TEST(Thermal, ContinuousUndoesDiscretise) {
  for (double tau : {0.5, 180.0, 600.0, 1e5}) {
    const Thermal back = Continuous(Discretise({-3, tau}, 1.0), 1.0);
    // 1 - te loses log10(tau / h) digits
    EXPECT_NEAR(back.time_constant, tau, 4e-16 * tau * tau + 1e-13 * tau);
    EXPECT_NEAR(back.gain, -3, 1e-15 * tau * 3 + 1e-13);
  }
}

TEST(Thermal, StepFollowsTheGoldenFilter) {
  const auto& golden = test::Golden()["filter"];
  const double ke = golden["ke"], te = golden["te"];
  double energy = golden["E0"];
  for (size_t i = 0; i < golden["W"].size(); ++i) {
    ExpectClose(energy, golden["E"][i]);
    energy = ThermalStep<double, double>(ke, te, energy, golden["W"][i]);
  }
}

TEST(Thermal, WarmsAtConstantSpeedAsTheClosedForm) {
  const auto& golden = test::Golden()["constant_speed"];
  const ConstantSpeed run{golden["v"], 5 * double(golden["v"]) + 15, {golden["ke"], golden["te"]}};
  for (size_t i = 1; i < golden["k"].size(); ++i) {
    // a recursion of n steps rounds n times
    const int steps = golden["k"][i];
    const double expected = golden["E_closed"][i];
    EXPECT_NEAR(run.Energy(steps), expected, (kClosedForm + 1e-15 * steps) * std::abs(expected));
  }
}

TEST(Thermal, SettlesWhereTheContinuousFormulaSays) {
  // E settles at k v F0 / (1 - k v), whatever the step (paper, feedback of W through E)
  const double v = 0.5, k = -3, nominal = 17.5;
  for (double h : {0.001, 1.0, 15.0}) {
    const ConstantSpeed run{v, nominal, Discretise({k, 600}, h)};
    const int steps = static_cast<int>(20 * 240 / h);
    EXPECT_NEAR(run.Energy(steps), k * v * nominal / (1 - k * v), 1e-6);
  }
}

TEST(Thermal, HoldsSteadyAtRest) {
  const DiscreteThermal pair = Discretise({-3, 600}, 1.0);
  EXPECT_EQ(ThermalStep(pair.gain, pair.pole, 0.0, Loss(0.0, WarmForce(0.0, 0.0, 0.0))), 0);
  EXPECT_EQ(WarmForce(0.0, 0.0, -4.0), 0) << "sign(0) = 0: energy costs nothing at rest";
}

TEST(Thermal, KnowsWhenFrictionPushes) {
  EXPECT_FALSE(FeedsItself(0.5, WarmForce(0.5, 17.5, -10.0)));
  EXPECT_TRUE(FeedsItself(0.5, WarmForce(0.5, 17.5, -18.0)));
  EXPECT_TRUE(FeedsItself(-0.5, WarmForce(-0.5, -17.5, -18.0)));
  EXPECT_FALSE(FeedsItself(0.0, 0.0));
}

}  // namespace
}  // namespace warmjoint
