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

/// Losses between 0 and 10 W with rests among them. Returns [n] W.
Eigen::VectorXd SomeLosses(Eigen::Index n) {
  Eigen::VectorXd loss(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    loss[i] = i % 7 < 2 ? 0.0 : 5 + 5 * std::sin(0.37 * static_cast<double>(i));
  }
  return loss;
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

TEST(ThermalFilter, TransposedIsItsAdjoint) {
  Eigen::VectorXd time = EvenTime(60, 1.0);
  for (const bool even : {true, false}) {
    if (!even) time[30] += 0.4;
    const ThermalFilter filter(time, {25});
    const Eigen::VectorXd loss = SomeLosses(60), weights = SomeLosses(61).tail(60);
    const Thermal thermal{-2, 20};
    const double forwards = weights.dot(filter.Energy(thermal, loss));
    // 1e-13: sums of 60 products
    EXPECT_NEAR(filter.Transposed(thermal, weights).dot(loss), forwards,
                1e-13 * std::abs(forwards));
  }
}

TEST(ThermalFilter, DerivativesAgreeWithFiniteDifferences) {
  Eigen::VectorXd time = EvenTime(60, 1.0);
  for (Eigen::Index i = 0; i < 60; ++i) time[i] += 0.3 * std::sin(2.1 * static_cast<double>(i));
  const Eigen::VectorXd loss = SomeLosses(60);
  const ThermalFilter filter(time);
  const double tau = 12, step = 1e-4;

  const Eigen::VectorXd here = filter.Energy({1, tau}, loss);
  const Eigen::VectorXd above = filter.Energy({1, tau * std::exp(step)}, loss);
  const Eigen::VectorXd below = filter.Energy({1, tau * std::exp(-step)}, loss);
  filter.ForEach(tau, loss, [&](Eigen::Index i, const UnitEnergy& S) {
    EXPECT_NEAR(S.value, here[i], 1e-13);
    // central differences: step^2 / 6 times the third derivative, which is of order 10
    EXPECT_NEAR(S.slope, (above[i] - below[i]) / (2 * step), 1e-7);
    // second difference: the same, and rounding 4 eps E / step^2
    EXPECT_NEAR(S.curvature, (above[i] - 2 * here[i] + below[i]) / (step * step), 1e-6);
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

TEST(ThermalFilter, TakesRoundedTimesForEven) {
  Eigen::VectorXd time = EvenTime(200, 0.05);
  const Eigen::VectorXd loss = SomeLosses(200);
  const Eigen::VectorXd exact = ThermalFilter(time).Energy({-1, 3}, loss);
  for (Eigen::Index i = 1; i < 199; ++i) time[i] += 1e-9 * std::cos(static_cast<double>(i));
  const Eigen::VectorXd rounded = ThermalFilter(time).Energy({-1, 3}, loss);
  // a step off by 2e-9 s moves E by W 2e-9 s / tau, that is 7e-9 N.m at most, in each direction
  EXPECT_LT((rounded - exact).cwiseAbs().maxCoeff(), 7e-9);
}

TEST(ThermalFilter, FiltersWithSeveralTimeConstantsAtOnce) {
  // even and uneven clocks, a second recording that starts cold
  for (const double jitter : {0.0, 0.3}) {
    Eigen::VectorXd time(40), loss(40);
    for (int i = 0; i < 40; ++i) {
      time[i] = 0.5 * i + jitter * (i % 3);
      loss[i] = 1 + i % 7;
    }
    const ThermalFilter filter(time, {25});
    const Fours<2> taus{Four{0.8, 3, 20, 50}, Four{0.1, 0.2, 0.3, 700}};
    Eigen::MatrixXd all(40, 8);
    auto write = filter.Together(taus, loss, 0.4);
    for (Eigen::Index i = 0; i < 40; ++i) {
      Fours<2> energies;
      write(i, energies);
      for (Eigen::Index k = 0; k < 8; ++k) all(i, k) = energies[static_cast<size_t>(k / 4)][k % 4];
    }
    for (Eigen::Index k = 0; k < 8; ++k) {
      // the same recursion
      const double tau = taus[static_cast<size_t>(k / 4)][k % 4];
      EXPECT_EQ(all.col(k), filter.Energy({1, tau}, loss, 0.4)) << jitter;
    }
  }
}

}  // namespace
}  // namespace warmjoint
