#include "identification/inference/hold_structure.h"

#include <gtest/gtest.h>

#include "identification/inference/covariance.h"

namespace warmjoint {
namespace {

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
  fit.parameters = {FitParameter{.name = "coulomb", .value = 15, .unit = "N.m"}};
  fit.used.keep = decltype(fit.used.keep)::Constant(n, true);
  fit.fitted = 15 * sign;
  fit.torque = fit.fitted + noise;
  fit.jacobian = [sign] { return Eigen::MatrixXd(sign); };
  fit.errors.cofactor = Eigen::MatrixXd::Constant(1, 1, 1.0 / static_cast<double>(n));
  return fit;
}

Disagreement MovedBy(double difference) {
  return {0, difference, 9, Eigen::VectorXd::Constant(1, difference)};
}

TEST(HoldStructure, LetsTheErrorsReachAsFarAsTheWhitenedFit) {
  Fit fit = LevelFit();
  const double before = CovarianceOf(fit).covariance(0, 0);
  fit.held_structure = {MovedBy(0.2), fit.fitted};
  const Inference inference = Infer(fit);
  EXPECT_TRUE(inference.without_intervals.empty());
  EXPECT_EQ(inference.warnings.size(), 1u);
  EXPECT_DOUBLE_EQ(inference.known.covariance(0, 0), before + 0.04);
}

TEST(HoldStructure, GivesNoIntervalsWhereItMovesTheFrictionByATenth) {
  // J d is 1.55 N.m of 15 everywhere, 10.3 %
  Fit fit = LevelFit();
  const double before = CovarianceOf(fit).covariance(0, 0);
  fit.held_structure = {MovedBy(1.55), fit.fitted};
  const Inference inference = Infer(fit);
  EXPECT_FALSE(inference.without_intervals.empty());
  EXPECT_DOUBLE_EQ(inference.known.covariance(0, 0), before);
}

}  // namespace
}  // namespace warmjoint
