#include "identification/online/kalman_bank.h"

#include <gtest/gtest.h>

namespace warmjoint {
namespace {

KalmanPrior<1> Prior() {
  KalmanPrior<1> prior;
  prior.state.mean << 10, 0, 0, 0;
  prior.state.covariance.setZero();
  prior.state.covariance(0, 0) = 4;
  prior.shortest = 10;
  prior.longest = 1000;
  prior.noise = 1;
  return prior;
}

/// A sample of a joint that does not warm: gain 0 without doubt.
KalmanSample<1> Sample(double level) {
  return {Eigen::Matrix<double, 1, 1>(1), 0.5, level, true, 1};
}

TEST(KalmanBank, CoversTheRangeEvenlyInTheLogarithm) {
  const KalmanState<1> all = Merge(MakeBank(Prior()));
  const double width = std::log(100.0);
  EXPECT_NEAR(all.mean[2], std::log(100.0), 1e-12);
  // 24 even points of deviation 0.6 of their distance: (1 + 2/23) / 12 width^2 + 0.36 spacing^2
  const double spacing = width / 23;
  const double even = spacing * spacing * (24.0 * 24 - 1) / 12;
  EXPECT_NEAR(all.covariance(2, 2), even + 0.36 * spacing * spacing, 1e-12);
}

TEST(KalmanBank, IsOneFilterWhereAllMembersAgree) {
  // without warming, time constants make no difference: the answer is the mean of Bayes
  KalmanBank<1> bank = MakeBank(Prior());
  bank.count = 1e300;  // a noise known beforehand
  for (const double level : {11.0, 12.0, 10.5}) bank = BankStep(bank, Sample(level));
  const KalmanState<1> all = Merge(bank);
  // closed forms, 1e-12
  EXPECT_NEAR(all.mean[0], (10 / 4.0 + 33.5) / (1 / 4.0 + 3), 1e-11);
  EXPECT_NEAR(all.covariance(0, 0), 1 / (1 / 4.0 + 3), 1e-12);
}

TEST(KalmanBank, WeighsMembersByTheirLikelihood) {
  KalmanBank<1> bank = MakeBank(Prior());
  bank.members[3].mean[0] = 14;
  const double variance = 4 + 1;
  bank = BankStep(bank, Sample(14));
  // exp(-(14 - 10)^2 / 2 / 5) against 1
  EXPECT_EQ(bank.log_weight[3], 0);
  EXPECT_NEAR(bank.log_weight[4], -0.5 * 16 / variance, 1e-12);
}

TEST(KalmanBank, LearnsTheNoise) {
  KalmanPrior<1> prior = Prior();
  prior.state.covariance.setZero();
  KalmanBank<1> bank = MakeBank(prior);
  for (int i = 0; i < 10000; ++i) bank = BankStep(bank, Sample(i % 2 ? 12 : 8));
  // innovations of 2 throughout; the guess of 1 still counts as 100 samples
  EXPECT_NEAR(bank.noise, 4, 0.05 * 4);
}

}  // namespace
}  // namespace warmjoint
