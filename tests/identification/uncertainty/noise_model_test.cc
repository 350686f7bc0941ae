#include "identification/uncertainty/noise_model.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace warmjoint
