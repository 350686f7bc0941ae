#include "identification/lack_of_fit/growing_fit.h"

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

Finding Ask(const VectorXd& residual, const Features& features) {
  GrowingFit fit(VectorXd::Ones(kRows), residual, kLevel, All());
  const AskedFeatures asked = fit.Ask({features});
  fit.LearnNoise(asked);
  return fit.Test(asked, 0);
}

/// How many of 300 residuals hold features with a p-value below `level`. height: of the first
int Count(const MatrixXd& features, double height, double coefficient, double level) {
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const VectorXd residual = height * features.col(0) + Noise(coefficient, seed);
    count += Ask(residual, {features}).p < level;
  }
  return count;
}

TEST(GrowingFit, SaysHowTheParametersMove) {
  // a level fitted to level + wave alone gives way by the wave's share: by least squares of both
  const VectorXd residual = 3 * Wave() + 0.01 * Noise(0, 1);
  const VectorXd centred = residual.array() - residual.mean();
  const Finding found = Ask(centred, {Wave()});
  ASSERT_LT(found.p, 1e-6);
  MatrixXd both(kRows, 2);
  both << kLevel, Wave();
  const VectorXd least = (both.transpose() * both).ldlt().solve(both.transpose() * centred);
  EXPECT_NEAR(found.moves[0], least[0], 1e-12);
  EXPECT_NEAR(found.explained, centred.squaredNorm() - (centred - both * least).squaredNorm(),
              1e-3);  // less what chance explains, (0.01)^2 and so many times its square root
}

TEST(GrowingFit, FindsByChanceNoMoreThanItsProbabilitySays) {
  // 1 % of 300 is 3; of a binomial of that mean more than 9 come once in 900 times
  MatrixXd waves(kRows, 3);
  waves << Wave(), Wave().array().square().matrix(), Transient();
  for (const double coefficient : {-0.5, 0.0, 0.5, 0.9}) {
    EXPECT_LE(Count(Wave(), 0, coefficient, 0.01), 9) << coefficient;
    EXPECT_LE(Count(Transient(), 0, coefficient, 0.01), 9) << coefficient;
    EXPECT_LE(Count(waves, 0, coefficient, 0.01), 9) << coefficient;
  }
}

TEST(GrowingFit, CountsTheCandidatesOfAScan) {
  const VectorXd residual = 0.2 * Wave() + Noise(0, 1);
  const Finding alone = Ask(residual, {Wave()}), scanned = Ask(residual, {Wave(), 10});
  EXPECT_NEAR(scanned.p, 10 * alone.p, 1e-12);
}

TEST(GrowingFit, FindsWhatIsSoonGone) {
  // e^-x over 13 rows a unit: sum of squares 6.7, so that a height of 3.5 is 9 deviations
  EXPECT_GE(Count(Transient(), 3.5, 0, 1e-4), 297);
}

TEST(GrowingFit, FindsWhatWouldPassForColouredNoise) {
  // next to no noise of its own: the wave is what an autoregression predicts best
  const VectorXd residual = Wave() + VectorXd(0.3 * Transient()) + 1e-3 * Noise(0, 1);
  EXPECT_LT(Ask(residual, {Wave()}).p, 1e-6);
}

TEST(GrowingFit, TakesWhatWasFound) {
  const Features wave{Wave()};
  GrowingFit fit(VectorXd::Ones(kRows), 3 * Wave() + 0.01 * Noise(0, 1), kLevel, All());
  const AskedFeatures asked = fit.Ask({wave});
  fit.LearnNoise(asked);
  EXPECT_LT(fit.Test(asked, 0).p, 1e-6);
  EXPECT_NEAR(fit.CoefficientOf(Wave()), 3, 1e-2);  // noise: 0.01/sqrt(200)
  fit.Take(wave);
  EXPECT_FALSE(fit.Test(fit.Ask({wave}), 0).made);
  EXPECT_EQ(fit.CoefficientOf(Wave()), 0);
  EXPECT_LT((fit.Explained() - 3 * Wave()).norm(), 0.01 * std::sqrt(kRows));
}

TEST(GrowingFit, AsksEachOfSeveralByItself) {
  // what features are asked beside makes no difference to what they explain; their noise is learned together
  const VectorXd residual = 0.3 * Wave() + Noise(0, 1);
  GrowingFit fit(VectorXd::Ones(kRows), residual, kLevel, All());
  const AskedFeatures both = fit.Ask({{Transient()}, {Wave(), 4}}), one = fit.Ask({{Wave(), 4}});
  fit.LearnNoise(both);
  const Finding among = fit.Test(both, 1), alone = fit.Test(one, 0);
  EXPECT_NEAR(among.p, alone.p, 1e-12 * alone.p);
  EXPECT_NEAR(among.moves[0], alone.moves[0], 1e-14);
}

TEST(GrowingFit, HasNothingToAskOfWhatItHolds) {
  EXPECT_FALSE(Ask(Noise(0, 1), {MatrixXd(kRows, 0)}).made);
  EXPECT_FALSE(Ask(Noise(0, 1), {kLevel}).made);
}

}  // namespace
}  // namespace warmjoint
