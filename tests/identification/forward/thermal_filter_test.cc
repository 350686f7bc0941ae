#include "identification/forward/thermal_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/vectors.h"

namespace warmjoint {
namespace {

Eigen::VectorXd EvenTime(Eigen::Index n, double h) {
  return Eigen::VectorXd::LinSpaced(n, 0, static_cast<double>(n - 1) * h);
}

TEST(ThermalFilter, FollowsTheGoldenFilterFromItsInitialEnergy) {
  const auto& golden = test::Golden()["filter"];
  const double h = 0.5;
  const Thermal thermal = Continuous({golden["ke"], golden["te"]}, h);

  const Eigen::VectorXd energy =
      ThermalFilter(EvenTime(8, h)).Energy(thermal, test::ToVector(golden["W"]), golden["E0"]);
  // 1e-12: closed form, through one logarithm and back
  EXPECT_LT((energy - test::ToVector(golden["E"])).norm(), 1e-12 * energy.norm());
}

TEST(ThermalFilter, SensitivitiesAreTheGoldenOnesByTheChainRule) {
  const auto& golden = test::Golden()["oe_sens"];
  const double ke = golden["ke"], te = golden["te"], h = 2;
  const double tau = Continuous({ke, te}, h).time_constant;
  const Eigen::VectorXd loss = test::ToVector(golden["W"]);
  const ThermalFilter filter(EvenTime(8, h));
  const Eigen::VectorXd initial = filter.Energy({0, tau}, Eigen::VectorXd::Zero(8), 1);  // dE/dE(0)

  filter.ForEach(tau, loss, [&](Eigen::Index i, const UnitEnergy& S) {
    const auto& row = golden["dE_dke_dte_dE0"][static_cast<size_t>(i)];
    // E = ke S / (1 - te) + te^i E(0), and dte/dtheta = te h/tau
    const double by_gain = S.value / (1 - te);
    const double by_pole =
        ke * S.value / ((1 - te) * (1 - te)) + ke / (1 - te) * S.slope / (te * h / tau) +
        (i > 0 ? static_cast<double>(i) * std::pow(te, i - 1) : 0.0) * golden["E0"].get<double>();
    // 1e-12: closed form; entries are of order 1
    EXPECT_NEAR(by_gain, row[0].get<double>(), 1e-12 * 10) << i;
    EXPECT_NEAR(by_pole, row[1].get<double>(), 1e-12 * 10) << i;
    EXPECT_NEAR(initial[i], row[2].get<double>(), 1e-12) << i;
  });
}

TEST(ThermalFilter, UnevenStepsAgreeWithAFineEvenGrid) {
  // losses change only on a grid of 4 s; the coarse times are a subset of the fine ones
  const Eigen::VectorXd fine_time = EvenTime(81, 0.5);
  Eigen::VectorXd fine_loss(81);
  for (Eigen::Index i = 0; i < 81; ++i) fine_loss[i] = static_cast<double>((i / 8) % 3);
  std::vector<Eigen::Index> taken;
  for (Eigen::Index i = 0; i < 81; ++i) {
    if (i % 8 == 0 || i % 5 == 0) taken.push_back(i);
  }

  const Thermal thermal{-2, 9};
  const Eigen::VectorXd fine = ThermalFilter(fine_time).Energy(thermal, fine_loss);
  const Eigen::VectorXd coarse = ThermalFilter(fine_time(taken)).Energy(thermal, fine_loss(taken));
  // both are exact: 1e-12 for closed forms
  EXPECT_LT((coarse - fine(taken)).norm(), 1e-12 * fine.norm());
}

}  // namespace
}  // namespace warmjoint
