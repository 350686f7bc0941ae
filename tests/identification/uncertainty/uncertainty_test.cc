#include "identification/uncertainty/uncertainty.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "identification/linear/least_squares.h"
#include "identification/uncertainty/tails.h"
#include "tests/support/judging.h"

namespace warmjoint {
namespace {

/// Share of 500 recordings (3600 s, law (2) without warming) whose 95 % intervals hold the truth,
/// for kv and kc. pole: of the autoregressive noise, of standard deviation 0.5 N.m.
Eigen::Vector2d Coverage(double pole, Eigen::Index rest) {
  Eigen::Vector2d covered = Eigen::Vector2d::Zero();
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    Measurements m =
        test::RecordFriction(test::Cold(), 1, test::AlternatingSpeeds(3600, seed, rest), 0, 0);
    RandomStream random({seed, 0}, Stream::torque_noise);
    double noise = 0.5 * random.Normal();
    for (double& torque : m.torque) {
      noise = pole * noise + 0.5 * std::sqrt(1 - pole * pole) * random.Normal();
      torque += noise;
    }
    const Estimate estimate = test::Fitted("nominal-ls", m);
    const auto holds = [&](const char* name, double truth) {
      const auto [lower, upper] = *estimate.Find(name)->interval95;
      return lower <= truth && truth <= upper;
    };
    covered += Eigen::Vector2d(holds("viscous", 5), holds("coulomb", 15));
  }
  return covered / 500;
}

// 500 runs know a share of 95 % to a standard deviation of 1 %; the bounds are three of them
void ExpectNominal(const Eigen::Vector2d& coverage) {
  for (double share : coverage) {
    EXPECT_GT(share, 0.92);
    EXPECT_LT(share, 0.98);
  }
}

TEST(Uncertainty, IntervalsHoldTheTruthUnderWhiteNoise) { ExpectNominal(Coverage(0, 0)); }

TEST(Uncertainty, IntervalsHoldTheTruthUnderColouredNoise) { ExpectNominal(Coverage(0.9, 0)); }

TEST(Uncertainty, IntervalsHoldTheTruthUnderColouredNoiseWithRests) {
  ExpectNominal(Coverage(0.9, 600));
}

/// Share of 500 intervals of a line's level and slope that hold the truth, 0. Noise of standard
/// deviation 0.2 + 2 x^2, x over -1 to 1 in turn, autoregressive with a pole.
Eigen::Vector2d CoverageUneven(double pole) {
  constexpr Eigen::Index n = 2000;
  const Selection all{Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(n, true), {}};
  Eigen::MatrixXd A(n, 2);
  for (Eigen::Index i = 0; i < n; ++i)
    A.row(i) << 1, std::abs(static_cast<double>(i % 400) / 200 - 1);
  const Eigen::MatrixXd cofactor = (A.transpose() * A).inverse();
  Eigen::Vector2d covered = Eigen::Vector2d::Zero();
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    RandomStream random({seed, 0}, Stream::test);
    Eigen::VectorXd y(n);
    double noise = random.Normal();
    for (Eigen::Index i = 0; i < n; ++i) {
      noise = pole * noise + std::sqrt(1 - pole * pole) * random.Normal();
      y[i] = (0.2 + 2 * std::pow(A(i, 1), 2)) * noise;
    }
    const Eigen::VectorXd x = cofactor * (A.transpose() * y);
    const Uncertainty known = JudgeUncertainty(A, cofactor, y - A * x, all, 20 * A.col(1));
    EXPECT_GT(known.uneven, 0);
    const double reach = StudentQuantile(known.freedom, kIntervalLevel);
    for (int i = 0; i < 2; ++i) covered[i] += std::abs(x[i]) < reach * known.Deviation(i);
  }
  return covered / 500;
}

TEST(Uncertainty, IntervalsHoldTheTruthUnderUnevenNoise) { ExpectNominal(CoverageUneven(0)); }

// the line through |r| is not quite the parabola that the noise follows
TEST(Uncertainty, IntervalsHoldTheTruthUnderUnevenColouredNoise) {
  ExpectNominal(CoverageUneven(0.7));
}

TEST(Uncertainty, IsTheUsualOneForWhiteNoise) {
  RandomStream random({1, 0}, Stream::test);
  Eigen::MatrixXd A(400, 2);
  Eigen::VectorXd residual(400);
  for (Eigen::Index i = 0; i < 400; ++i) {
    A.row(i) << 1, random.Normal();
    residual[i] = random.Normal();
  }
  const Selection all{Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(400, true), {}};
  const Eigen::MatrixXd cofactor = (A.transpose() * A).inverse();
  const Uncertainty known = JudgeUncertainty(A, cofactor, residual, all);
  EXPECT_EQ(known.noise.order(), 0);
  EXPECT_EQ(known.freedom, 398);
  EXPECT_EQ(known.covariance, residual.squaredNorm() / 398 * cofactor);
  EXPECT_EQ(ColourOf(known.noise), "");
}

}  // namespace
}  // namespace warmjoint
