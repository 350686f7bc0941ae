#include "identification/uncertainty/prior_of_weights.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

/// exp(-d^2 / (2 length^2)), firm enough to be factored.
Eigen::MatrixXd Gaussian(Eigen::Index size, double length) {
  Eigen::MatrixXd alike(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j < size; ++j) {
      alike(i, j) = std::exp(-std::pow(double(i - j) / length, 2) / 2);
    }
  }
  alike.diagonal().array() += 1e-6;
  return alike;
}

/// 20 weights of variance 4, found by ridge from overlapping kernels in noise of variance 0.01:
/// C = (G + s)^-1, L = C G, B = s^2 C G C, V = 0.01 C G C.
struct Drawn {
  Eigen::VectorXd found;
  Eigen::MatrixXd left, bias, noise;

  Drawn(const Eigen::MatrixXd& alike, std::uint64_t seed) {
    const double s = 0.1, variance = 0.01;
    const Eigen::MatrixXd gram = Gaussian(20, 1.5);
    const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(20, 20);
    const Eigen::MatrixXd inverse = (gram + s * one).inverse();
    left = inverse * gram;
    noise = variance * left * inverse;
    bias = s * s / variance * noise;
    RandomStream random({seed, 3}, Stream::torque_noise);
    Eigen::VectorXd independent(20), shaken(20);
    for (double& weight : independent) weight = 2 * random.Normal();
    for (double& product : shaken) product = std::sqrt(variance) * random.Normal();
    const Eigen::MatrixXd root = alike.llt().matrixL(), of_noise = gram.llt().matrixL();
    found = left * root * independent + inverse * of_noise * shaken;
  }
  Eigen::MatrixXd Prior() const {
    return PriorOfWeights({found, left, bias, noise},
                          [](double length) { return Gaussian(20, length); });
  }
};

// by hand: s_w^2 = (sum b w^2 - sum b v) / sum b l^2, and the scatter is 1e-6 of it
TEST(PriorOfWeights, CountsEachWeightByItsPull) {
  const Eigen::Vector2d found{1, 3}, left{0.9, 0.2}, bias{0.01, 0.5}, noise{1e-6, 1e-6};
  const Eigen::MatrixXd l = left.asDiagonal(), b = bias.asDiagonal(), v = noise.asDiagonal();
  const Eigen::MatrixXd prior = PriorOfWeights({found, l, b, v}, nullptr);
  const double expected = (0.01 * 1 + 0.5 * 9) / (0.01 * 0.81 + 0.5 * 0.04);
  EXPECT_NEAR(prior(0, 0), expected, 1e-5 * expected);
  EXPECT_EQ(prior(0, 0), prior(1, 1));
  EXPECT_EQ(prior(0, 1), 0);
}

// weights that cannot be seen: found 0, and noise that is far larger than they are
TEST(PriorOfWeights, CallsNoWeightsSurelyNothing) {
  const Eigen::VectorXd found = Eigen::VectorXd::Zero(2);
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(2, 2);
  const Eigen::MatrixXd prior = PriorOfWeights({found, 0.5 * one, one, 4 * one}, nullptr);
  EXPECT_NEAR(prior(0, 0), std::sqrt(2 * 2 * 16.0) / (2 * 0.25), 1e-12);
}

// at 1 % a log; more than six of 200 have a probability of 0.5 %
TEST(PriorOfWeights, LeavesIndependentWeightsApart) {
  int together = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    together += Drawn(Eigen::MatrixXd::Identity(20, 20), seed).Prior()(0, 1) != 0;
  }
  EXPECT_LE(together, 6);
}

// the variance is 4 to its scatter over the draws, 2.3 / sqrt(50), four times
TEST(PriorOfWeights, SeesThatSmoothWeightsGoTogether) {
  const Eigen::MatrixXd alike = Gaussian(20, 2);
  int right = 0;
  double variance = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Eigen::MatrixXd prior = Drawn(alike, seed).Prior();
    right += std::abs(prior(4, 5) / prior(4, 4) - alike(4, 5)) < 1e-3;
    variance += prior(4, 4) / 50;
  }
  EXPECT_GE(right, 40) << "the length that they were drawn with, or one next to it";
  EXPECT_NEAR(variance, 4, 1.3);
}

}  // namespace
}  // namespace warmjoint
