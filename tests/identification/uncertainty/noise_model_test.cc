#include "identification/uncertainty/noise_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/coloured_noise.h"

namespace warmjoint {
namespace {

using test::Coloured;

Selection Keep(Eigen::Index n, Eigen::Index gap) {
  Selection selection{Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(n, true), {}};
  for (Eigen::Index i = 0; gap > 0 && i < n; ++i) selection.keep[i] = i / gap % 2 == 0;
  return selection;
}

Eigen::VectorXd KeptOf(const Eigen::VectorXd& all, const Selection& selection) {
  Eigen::VectorXd kept(selection.count());
  Eigen::Index row = 0;
  for (Eigen::Index i = 0; i < all.size(); ++i) {
    if (selection.keep[i]) kept[row++] = all[i];
  }
  return kept;
}

TEST(NoiseModel, TakesWhiteNoiseForWhite) {
  int white = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    white += FitNoise(Coloured(3600, 0, seed), Keep(3600, 0)).order() == 0;
  }
  // BIC takes one order of 6 for real when its log-likelihood is ln(n)/2 = 4 above chance: 2.5 %
  EXPECT_GE(white, 92);
}

TEST(NoiseModel, FindsTheColourOfAutoregressiveNoiseAcrossGaps) {
  for (Eigen::Index gap : {0, 300}) {
    const Selection selection = Keep(20000, gap);
    const NoiseModel noise = FitNoise(KeptOf(Coloured(20000, 0.9, 7), selection), selection);
    ASSERT_GE(noise.order(), 1) << gap;
    // standard deviation of a pole: sqrt((1 - 0.81) / 10000) = 0.0044
    EXPECT_NEAR(noise.correlation, 0.9, 4 * 0.0044) << gap;
    EXPECT_NEAR(noise.coefficients[0], -0.9, 0.05) << gap;
    // (1 + 0.81) / (1 - 0.81), within what four deviations of the pole make of it
    EXPECT_NEAR(noise.variance_inflation, 9.5, 2.5) << gap;
  }
}

/// Autocorrelations of e[i] = 0.3 e[i-1] + 0.4 e[i-2] + w[i], by the equations of Yule and Walker. [n]
std::vector<double> CorrelationsOfTwo(size_t n) {
  std::vector<double> rho{1, 0.3 / (1 - 0.4)};
  while (rho.size() < n) rho.push_back(0.3 * rho.back() + 0.4 * rho[rho.size() - 2]);
  return rho;
}

TEST(NoiseModel, ScatterIsThatOfTheAutocovariance) {
  // A^T R A by the model against R written out, at kept samples with a gap; an order beyond 2 has coefficients of 0
  const std::vector<double> rho = CorrelationsOfTwo(60);
  const Selection selection = Keep(60, 20);
  for (const Eigen::Index order : {2, 3, 6}) {
    NoiseModel noise;
    noise.coefficients = Eigen::VectorXd::Zero(order);
    noise.coefficients.head(2) << -0.3, -0.4;
    noise.variance = 4;
    noise.innovation = 4 * (1 - 0.3 * rho[1] - 0.4 * rho[2]);
    for (Eigen::Index d = 1; d <= 8; ++d) {
      Eigen::MatrixXd all(60, d);
      for (Eigen::Index i = 0; i < 60; ++i) {
        for (Eigen::Index j = 0; j < d; ++j) all(i, j) = std::cos(0.3 * static_cast<double>(i * j));
      }

      // samples that are not kept count as 0
      for (Eigen::Index i = 0; i < 60; ++i) {
        if (!selection.keep[i]) all.row(i).setZero();
      }
      Eigen::MatrixXd R(60, 60);
      for (Eigen::Index i = 0; i < 60; ++i) {
        for (Eigen::Index j = 0; j < 60; ++j)
          R(i, j) = 4 * rho[static_cast<size_t>(std::abs(i - j))];
      }
      const Eigen::MatrixXd expected = all.transpose() * R * all;
      Eigen::MatrixXd kept(selection.count(), d);
      for (Eigen::Index j = 0; j < d; ++j) kept.col(j) = KeptOf(all.col(j), selection);
      // 1e-6: the filter stops where it has died away to 1e-4, squared, of its largest
      EXPECT_LT((ScatterThrough(noise, kept, selection) - expected).norm(), 1e-6 * expected.norm())
          << order << " " << d;
    }
  }
}

TEST(NoiseModel, SurvivesAResidualOfZerosAndOfThreeSamples) {
  EXPECT_EQ(FitNoise(Eigen::VectorXd::Zero(100), Keep(100, 0)).order(), 0);
  EXPECT_EQ(FitNoise(Eigen::Vector3d(1, -1, 1), Keep(3, 0)).order(), 0);
}

}  // namespace
}  // namespace warmjoint
