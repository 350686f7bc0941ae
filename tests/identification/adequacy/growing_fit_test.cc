#include "identification/adequacy/growing_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kRows = 400;

Selection All() { return {Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(kRows, true), {}}; }

/// AR(1) noise of deviation 1.
VectorXd Noise(double coefficient, std::uint64_t seed) {
  RandomStream random({seed, 0}, Stream::test);
  VectorXd noise(kRows);
  double e = random.Normal();
  for (double& value : noise) {
    value = e;
    e = coefficient * e + std::sqrt(1 - coefficient * coefficient) * random.Normal();
  }
  return noise;
}

/// A transient that is gone after a tenth of the rows. [m x 1]
MatrixXd Transient() { return (-VectorXd::LinSpaced(kRows, 0, 30).array()).exp().matrix(); }

/// A wave over all of the rows. [m x 1]
MatrixXd Wave() { return (VectorXd::LinSpaced(kRows, 0, 40).array()).sin().matrix(); }

const MatrixXd kLevel = MatrixXd::Ones(kRows, 1);

std::optional<Structure> Ask(const VectorXd& residual, const Block& block) {
  return GrowingFit(VectorXd::Ones(kRows), residual, kLevel, All(), {block}).Test(block);
}

/// How many of 300 residuals are said to hold a feature. height: of it
int Count(Dependence on, const MatrixXd& feature, double height, double coefficient) {
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const VectorXd residual = height * feature.col(0) + Noise(coefficient, seed);
    count += Ask(residual, {on, feature}).has_value();
  }
  return count;
}

TEST(GrowingFit, SaysHowTheParametersMove) {
  // a level fitted to level + wave alone gives way by the wave's share: by least squares of both
  const VectorXd residual = 3 * Wave() + 0.01 * Noise(0, 1);
  const VectorXd centred = residual.array() - residual.mean();
  const auto found = Ask(centred, {Dependence::time, Wave()});
  ASSERT_TRUE(found);
  MatrixXd both(kRows, 2);
  both << kLevel, Wave();
  const VectorXd least = (both.transpose() * both).ldlt().solve(both.transpose() * centred);
  EXPECT_NEAR(found->moves[0], least[0], 1e-12);
  EXPECT_NEAR(found->explained, centred.squaredNorm() - (centred - both * least).squaredNorm(),
              1e-3);  // less what chance explains, (0.01)^2 and so many times its square root
}

TEST(GrowingFit, FindsNothingInNoiseOfAnyColour) {
  // chance: for a single coefficient one in 2000, of 300 more than 2 in 1000 tests; for several one
  // in a million
  MatrixXd waves(kRows, 3);
  waves << Wave(), Wave().array().square().matrix(), Transient();
  for (const double coefficient : {-0.5, 0.0, 0.5, 0.9}) {
    EXPECT_LE(Count(Dependence::time, Wave(), 0, coefficient), 2) << coefficient;
    EXPECT_LE(Count(Dependence::energy, Transient(), 0, coefficient), 2) << coefficient;
    EXPECT_EQ(Count(Dependence::energy, waves, 0, coefficient), 0) << coefficient;
  }
}

TEST(GrowingFit, FindsAStartByChanceOnceInEighty) {
  // two-sided beyond 2.5 of a normal: 1.24 %, 3.7 of 300; 10 has a chance below 1 %
  EXPECT_LE(Count(Dependence::initial_energy, Transient(), 0, 0), 10);
  EXPECT_LE(Count(Dependence::initial_energy, Transient(), 0, 0.5), 10);
}

TEST(GrowingFit, FindsWhatIsSoonGone) {
  // e^-x over 13 rows a unit: sum of squares 6.7, so that a height of 3.5 is 9 deviations
  EXPECT_GE(Count(Dependence::energy, Transient(), 3.5, 0), 297);
}

TEST(GrowingFit, FindsWhatWouldPassForColouredNoise) {
  // next to no noise of its own: the wave is what an autoregression predicts best
  const VectorXd residual = Wave() + VectorXd(0.3 * Transient()) + 1e-3 * Noise(0, 1);
  EXPECT_TRUE(Ask(residual, {Dependence::time, Wave()}));
}

TEST(GrowingFit, TakesWhatWasFound) {
  const Block wave{Dependence::time, Wave()};
  GrowingFit fit(VectorXd::Ones(kRows), 3 * Wave() + 0.01 * Noise(0, 1), kLevel, All(), {wave});
  EXPECT_TRUE(fit.Test(wave));
  fit.Take(wave);
  EXPECT_FALSE(fit.Test(wave));
  EXPECT_LT((fit.Explained() - 3 * Wave()).norm(), 0.01 * std::sqrt(kRows));
}

TEST(GrowingFit, HasNothingToAskOfAnEmptyBlock) {
  EXPECT_FALSE(Ask(Noise(0, 1), {Dependence::time, MatrixXd(kRows, 0)}));
  EXPECT_FALSE(Ask(Noise(0, 1), {Dependence::time, kLevel}));  // which the fit holds
}

}  // namespace
}  // namespace warmjoint
