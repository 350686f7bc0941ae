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
    EXPECT_NEAR(noise.redundancy, 9.5, 2.5) << gap;
  }
}

TEST(NoiseModel, ScatterIsThatOfTheAutocovariance) {
  // A^T R A by the model against R written out, at kept samples with a gap
  NoiseModel noise;
  noise.coefficients = Eigen::VectorXd::Constant(1, -0.8);
  noise.variance = 4;
  noise.innovation = 4 * (1 - 0.64);
  const Selection selection = Keep(60, 20);
  Eigen::MatrixXd A(selection.count(), 2);
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    A.row(i) << 1, std::sin(0.3 * static_cast<double>(i));
  }

  std::vector<double> at;
  for (Eigen::Index i = 0; i < 60; ++i) {
    if (selection.keep[i]) at.push_back(static_cast<double>(i));
  }
  Eigen::MatrixXd R(A.rows(), A.rows());
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    for (Eigen::Index j = 0; j < A.rows(); ++j)
      R(i, j) = 4 * std::pow(0.8, std::abs(at[i] - at[j]));
  }
  const Eigen::MatrixXd expected = A.transpose() * R * A;
  // 1e-6: the filter stops where it has died away to 1e-4, squared, of its largest
  EXPECT_LT((ScatterThrough(noise, A, selection) - expected).norm(), 1e-6 * expected.norm());
}

TEST(NoiseModel, SurvivesAResidualOfZerosAndOfThreeSamples) {
  EXPECT_EQ(FitNoise(Eigen::VectorXd::Zero(100), Keep(100, 0)).order(), 0);
  EXPECT_EQ(FitNoise(Eigen::Vector3d(1, -1, 1), Keep(3, 0)).order(), 0);
}

}  // namespace
}  // namespace warmjoint
