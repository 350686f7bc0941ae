#include "identification/inference/hausman_test.h"

#include <gtest/gtest.h>

#include <cmath>

#include "identification/fit/fit_parameters.h"
#include "identification/inference/inference.h"
#include "identification/uncertainty/tails.h"
#include "identification/uncertainty/whitening.h"
#include "models/foundation/random_stream.h"
#include "tests/support/coloured_noise.h"

namespace warmjoint {
namespace {

using test::Coloured;

constexpr double kMany = 1e6;  // degrees of freedom

FitOfRows TwoRows(double first, double second, double variance) {
  return {Eigen::Vector2d(first, second), variance * Eigen::Matrix2d::Identity()};
}

TEST(Disagreement, IsADifferenceThatNoiseDoesNotMake) {
  // the difference has the variance 4 - 3 = 1: two parameters ask for a little more than 5 deviations
  EXPECT_FALSE(FindDisagreement(TwoRows(0, 0, 4), TwoRows(5, 5, 3), kMany));
  const auto found = FindDisagreement(TwoRows(0, 0, 4), TwoRows(1, -5.3, 3), kMany);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->parameter, 1);
  EXPECT_DOUBLE_EQ(found->differences[found->parameter], -5.3);
  EXPECT_DOUBLE_EQ(found->deviations, 5.3);
  // which a variance that is known from a few samples alone may make
  EXPECT_FALSE(FindDisagreement(TwoRows(0, 0, 4), TwoRows(1, -5.3, 3), 10));
}

TEST(Disagreement, CountsATenthOfTheVarianceWhereBothFitsAreAsGood) {
  // a tenth of the variance counts: sqrt(0.1) 5.2 = 1.64 deviations of the fits themselves
  EXPECT_FALSE(FindDisagreement(TwoRows(0, 0, 1), TwoRows(1.5, 0, 1), kMany));
  EXPECT_TRUE(FindDisagreement(TwoRows(0, 0, 1), TwoRows(1.7, 0, 1), kMany));
  EXPECT_FALSE(FindDisagreement(TwoRows(0, 0, 1), TwoRows(0, 0, 1), kMany));
}

TEST(ReachBeyondEnds, IsTheTwoSidedQuantileOfOneAndTheOneSidedOfTwoFarApart) {
  EXPECT_NEAR(ReachBeyondEnds(0), 1.959964, 1e-4);
  EXPECT_NEAR(ReachBeyondEnds(10), 1.644854, 1e-5);
  EXPECT_LT(ReachBeyondEnds(1), ReachBeyondEnds(0.5));
}

TEST(ReachBeyondEnds, HoldsEitherEndAsOftenAsItSays) {
  constexpr int kDraws = 100'000;
  RandomStream random({6, 3}, Stream::test);
  for (const double range : {0.2, 1.0, 4.0}) {
    const double reach = ReachBeyondEnds(range);
    int held = 0;
    for (int i = 0; i < kDraws; ++i) {
      // the truth is one end, 0; the other lies above the estimate of it
      const double estimate = random.Normal();
      held += estimate - reach <= 0 && 0 <= estimate + range + reach;
    }
    // 4 standard errors
    const double share = static_cast<double>(held) / kDraws;
    EXPECT_NEAR(share, 0.95, 4 * std::sqrt(0.95 * 0.05 / kDraws)) << range;
  }
}

TEST(TurnsWithDirection, IsSaidOfFrictionAndNotOfTorque) {
  Eigen::VectorXd velocity(1000);
  for (Eigen::Index i = 0; i < 1000; ++i) velocity[i] = i / 20 % 2 == 0 ? 1 : -1;
  int turning = 0, found = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Eigen::VectorXd noise = Coloured(1000, 0.9, seed);
    // colour of the torque seldom turns, colour of the friction does
    turning += *TurnsWithDirection(noise, velocity);
    found += *TurnsWithDirection(Coloured(1000, 0.99, seed).cwiseProduct(velocity), velocity);
  }
  EXPECT_LE(turning, 1);  // three deviations to one side: one in 700
  EXPECT_GE(found, 90);   // 50 runs whose means correlate by exp(-0.2): 5 deviations on average
}

TEST(TurnsWithDirection, NeedsNineChangesOfDirection) {
  const auto turns = [](Eigen::Index changes) {
    Eigen::VectorXd velocity(changes + 1);
    for (Eigen::Index i = 0; i <= changes; ++i) velocity[i] = i % 2 == 0 ? 1 : -1;
    return TurnsWithDirection(3 * velocity, velocity);
  };
  EXPECT_FALSE(turns(8));
  EXPECT_EQ(turns(9), false);  // all of nine are three deviations, and not more
  EXPECT_EQ(turns(10), true);
  EXPECT_FALSE(TurnsWithDirection(Eigen::VectorXd::Ones(50), Eigen::VectorXd::Ones(50)));
}

constexpr Eigen::Index kSamples = 400;

/// 15 sign v with white noise of 0.1 N.m, J = sign v.
Fit LevelFit() {
  Fit fit;
  const Eigen::Index n = kSamples;
  Eigen::VectorXd sign(n), noise(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    sign[i] = i / 20 % 2 ? -1 : 1;
    // white enough: a sequence of signs with little correlation
    noise[i] = 0.1 * ((i * 7919 + i * i * 31) % 97 < 48 ? -1 : 1);
  }
  fit.parameters = {WithValue({.name = "coulomb", .unit = "N.m"}, 15)};
  fit.rows.used.keep = decltype(fit.rows.used.keep)::Constant(n, true);
  fit.rows.fitted = 15 * sign;
  fit.rows.torque = fit.rows.fitted + noise;
  fit.rows.jacobian = [sign] { return Eigen::MatrixXd(sign); };
  fit.rows.errors.cofactor = Eigen::MatrixXd::Constant(1, 1, 1.0 / static_cast<double>(n));
  return fit;
}

Disagreement MovedBy(double difference) { return {0, 9, Eigen::VectorXd::Constant(1, difference)}; }

TEST(StructureCause, LetsIntervalsReachAsFarAsTheWhitenedFit) {
  Fit fit = LevelFit();
  const Inference before = Infer(fit);
  fit.causes.push_back(StructureCause(MovedBy(0.2), fit.rows.fitted, fit));
  const Inference inference = Infer(fit);
  EXPECT_EQ(inference.warnings.size(), 1u);
  const ParameterInterval& coulomb = inference.parameters[0];
  const double reach = StudentQuantile(before.uncertainty.degrees_of_freedom, kIntervalLevel) * 0.2;
  EXPECT_DOUBLE_EQ(coulomb.value, 15);
  EXPECT_NEAR(coulomb.HalfWidth(), before.parameters[0].HalfWidth() + reach, 1e-12);
  EXPECT_EQ(coulomb.parts.back().by, Source::structure);
  EXPECT_NEAR(coulomb.parts.back().half_width, reach, 1e-12);
  // noise stays noise
  EXPECT_EQ(inference.uncertainty.covariance, before.uncertainty.covariance);
}

TEST(StructureCause, IsOfTheValueOfALogarithm) {
  Fit fit = LevelFit();
  const Cause of_value = StructureCause(MovedBy(0.01), fit.rows.fitted, fit);
  fit.parameters[0].coordinate = Coordinate::logarithm;
  const Cause of_logarithm = StructureCause(MovedBy(0.01), fit.rows.fitted, fit);
  EXPECT_DOUBLE_EQ(of_logarithm.spread(0, 0), 15 * of_value.spread(0, 0));
}

TEST(StructureCause, GivesNoIntervalsWhereItMovesTheFrictionByATenth) {
  // J d is 1.55 N.m of 15 everywhere, 10.3 %
  Fit fit = LevelFit();
  fit.causes.push_back(StructureCause(MovedBy(1.55), fit.rows.fitted, fit));
  EXPECT_FALSE(HasIntervals(Infer(fit)));
}

}  // namespace
}  // namespace warmjoint
