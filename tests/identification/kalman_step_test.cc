#include "identification/kalman_step.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

namespace warmjoint {
namespace {

KalmanState Some() {
  KalmanState state;
  state.mean = Eigen::VectorXd(5);
  state.mean << 5, 15, -3, std::log(600.0), -4;
  Eigen::MatrixXd root = Eigen::MatrixXd::Identity(5, 5);
  root(1, 0) = 0.5;
  root(4, 2) = -0.3;
  state.covariance = root * root.transpose();
  return state;
}

KalmanSample Moving() { return {Eigen::Vector2d(0.5, 1), 0.5, 14, true, 10}; }

TEST(KalmanStep, IsAPureFunctionOfItsArguments) {
  const KalmanState before = Some();
  const KalmanNoise noise{0.25, Eigen::VectorXd::Constant(5, 1e-3)};
  const KalmanState once = KalmanStep(before, Moving(), noise);
  const KalmanState twice = KalmanStep(before, Moving(), noise);
  EXPECT_EQ(once.mean, twice.mean);
  EXPECT_EQ(once.covariance, twice.covariance);
  EXPECT_EQ(before.mean, Some().mean);
}

TEST(KalmanStep, CoolsAtRest) {
  KalmanSample rest = Moving();
  rest.speed = 0;
  rest.measured = false;
  const KalmanState next = KalmanStep(Some(), rest, {0.25, Eigen::VectorXd::Zero(5)});
  // closed form, 1e-12
  EXPECT_NEAR(next.mean[4], -4 * std::exp(-10.0 / 600), 4e-12);
  EXPECT_EQ(next.mean.head(4), Some().mean.head(4));
}

TEST(KalmanStep, PropagatesTheCovarianceByTheJacobianOfTheMotion) {
  // unmeasured: the covariance is F P F^T with F by central differences of the mean
  KalmanSample sample = Moving();
  sample.measured = false;
  const KalmanNoise noise{0.25, Eigen::VectorXd::Zero(5)};
  const double step = 1e-6;
  Eigen::MatrixXd F(5, 5);
  for (Eigen::Index j = 0; j < 5; ++j) {
    KalmanState above = Some(), below = Some();
    above.mean[j] += step;
    below.mean[j] -= step;
    F.col(j) = (KalmanStep(above, sample, noise).mean - KalmanStep(below, sample, noise).mean) /
               (2 * step);
  }
  const Eigen::MatrixXd expected = F * Some().covariance * F.transpose();
  // central differences: rounding 15 eps / step = 3e-9
  EXPECT_LT((KalmanStep(Some(), sample, noise).covariance - expected).norm(), 1e-7);
}

TEST(KalmanStep, TakesInAMeasurementAsBayesSays) {
  // at rest for no time the step is the correction alone: (P^-1 + a a^T / r)^-1
  KalmanSample sample = Moving();
  sample.step = 0;
  const KalmanState next = KalmanStep(Some(), sample, {0.25, Eigen::VectorXd::Zero(5)});
  Eigen::VectorXd a(5);
  a << 0.5, 1, 0, 0, 1;
  const Eigen::MatrixXd information = Some().covariance.inverse() + a * a.transpose() / 0.25;
  EXPECT_LT((next.covariance - information.inverse()).norm(), 1e-12);
  const Eigen::VectorXd mean =
      Some().mean + information.inverse() * a * (14 - a.dot(Some().mean)) / 0.25;
  EXPECT_LT((next.mean - mean).norm(), 1e-12);
}

}  // namespace
}  // namespace warmjoint
