#include "identification/online/kalman_step.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace warmjoint {
namespace {

KalmanState<2> Some() {
  KalmanState<2> state;
  state.mean << 5, 15, -3, std::log(600.0), -4;
  Eigen::Matrix<double, 5, 5> root = Eigen::Matrix<double, 5, 5>::Identity();
  root(1, 0) = 0.5;
  root(4, 2) = -0.3;
  state.covariance = root * root.transpose();
  return state;
}

KalmanSample<2> Moving() { return {Eigen::Vector2d(0.5, 1), 0.5, 14, true, 10}; }

KalmanSample<2> Unmeasured() {
  KalmanSample<2> sample = Moving();
  sample.measured = false;
  return sample;
}

TEST(KalmanStep, CoolsAtRest) {
  KalmanSample<2> rest = Unmeasured();
  rest.speed = 0;
  const KalmanState<2> next = KalmanStep(Some(), rest, 0.25).state;
  // closed form, 1e-12
  EXPECT_NEAR(next.mean[4], -4 * std::exp(-10.0 / 600), 4e-12);
  EXPECT_EQ(next.mean.head<4>(), Some().mean.head<4>());
}

TEST(KalmanStep, MovesTheEnergyByEquation22) {
  const KalmanState<2> next = KalmanStep(Some(), Unmeasured(), 0.25).state;
  const double pole = std::exp(-10.0 / 600);
  const double loss = 0.5 * (5 * 0.5 + 15 - 4);
  EXPECT_NEAR(next.mean[4], pole * -4 - 3 * (1 - pole) * loss, 4e-12);
}

TEST(KalmanStep, PropagatesTheCovarianceByTheJacobianOfTheMotion) {
  // the covariance is F P F^T with F by central differences of the mean
  const double step = 1e-6;
  Eigen::Matrix<double, 5, 5> F;
  for (Eigen::Index j = 0; j < 5; ++j) {
    KalmanState<2> above = Some(), below = Some();
    above.mean[j] += step;
    below.mean[j] -= step;
    F.col(j) = (KalmanStep(above, Unmeasured(), 0.25).state.mean -
                KalmanStep(below, Unmeasured(), 0.25).state.mean) /
               (2 * step);
  }
  const Eigen::Matrix<double, 5, 5> expected = F * Some().covariance * F.transpose();
  // central differences: rounding 15 eps / step = 3e-9
  EXPECT_LT((KalmanStep(Some(), Unmeasured(), 0.25).state.covariance - expected).norm(), 1e-7);
}

TEST(KalmanStep, TakesInAMeasurementAsBayesSays) {
  // for no time the step is the correction alone: (P^-1 + a a^T / r)^-1
  KalmanSample<2> sample = Moving();
  sample.step = 0;
  const KalmanOutcome<2> outcome = KalmanStep(Some(), sample, 0.25);
  Eigen::Matrix<double, 5, 1> a;
  a << 0.5, 1, 0, 0, 1;
  const Eigen::Matrix<double, 5, 5> cofactor =
      (Some().covariance.inverse() + a * a.transpose() / 0.25).inverse();
  const double innovation = 14 - a.dot(Some().mean);
  // closed forms, 1e-12
  EXPECT_LT((outcome.state.covariance - cofactor).norm(), 1e-12);
  EXPECT_LT((outcome.state.mean - Some().mean - cofactor * a * innovation / 0.25).norm(), 1e-12);
  EXPECT_NEAR(outcome.innovation, innovation, 1e-12);
  EXPECT_NEAR(outcome.variance, a.dot(Some().covariance * a) + 0.25, 1e-12);
}

TEST(KalmanStep, IsTheSameForASizeKnownAtRunTime) {
  const KalmanState<Eigen::Dynamic> some{Some().mean, Some().covariance};
  const KalmanSample<Eigen::Dynamic> sample{Moving().levels, 0.5, 14, true, 10};
  const KalmanState<Eigen::Dynamic> next = KalmanStep(some, sample, 0.25).state;
  // linear algebra, 1e-12
  EXPECT_LT((next.mean - KalmanStep(Some(), Moving(), 0.25).state.mean).norm(), 1e-12);
}

}  // namespace
}  // namespace warmjoint
