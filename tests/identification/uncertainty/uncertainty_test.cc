#include "identification/uncertainty/uncertainty.h"

#include <gtest/gtest.h>
#include <warmjoint/recording.h>

#include <Eigen/LU>
#include <cmath>

#include "identification/fit/fit_data.h"
#include "identification/model/normal_equations.h"
#include "identification/uncertainty/few_segments.h"
#include "identification/uncertainty/noise_model.h"
#include "identification/uncertainty/tails.h"
#include "identification/uncertainty/uncertainty.h"
#include "identification/uncertainty/weight_prior.h"
#include "models/foundation/random_stream.h"
#include "tests/support/coloured_noise.h"
#include "tests/support/judging.h"

namespace warmjoint {
namespace {

using test::Coloured;

/// Share of 500 recordings (3600 s, law (2) without warming) whose 95 % intervals hold the truth,
/// for kv and kc. pole: of the autoregressive noise, of standard deviation 0.5 N.m.
Eigen::Vector2d Coverage(double pole, Eigen::Index rest) {
  Eigen::Vector2d covered = Eigen::Vector2d::Zero();
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    Measurements m =
        test::RecordFriction(test::Cold(), 1, test::AlternatingSpeeds(3600, seed, rest), 0, 0);
    test::AddNoise(m, 0.5, pole, seed);
    const Estimate estimate = test::Fitted("nominal-ls", m);
    covered +=
        Eigen::Vector2d(test::Holds(estimate, "viscous", 5), test::Holds(estimate, "coulomb", 15));
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
  Eigen::MatrixXd A(n, 2);
  for (Eigen::Index i = 0; i < n; ++i)
    A.row(i) << 1, std::abs(static_cast<double>(i % 400) / 200 - 1);
  const Eigen::MatrixXd cofactor = (A.transpose() * A).inverse();
  const Eigen::ArrayXd deviation = 0.2 + 2 * A.col(1).array().square();
  Eigen::Vector2d covered = Eigen::Vector2d::Zero();
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const Eigen::VectorXd y = deviation * Coloured(n, pole, seed).array();
    const Eigen::VectorXd x = cofactor * (A.transpose() * y);
    const Uncertainty known = CovarianceOf({.rows = RowsFrom([&] { return A; }),
                                            .cofactor = cofactor,
                                            .residual = y - A * x,
                                            .selection = warmjoint::AllOf(n),
                                            .fitted = 20 * A.col(1)});
    EXPECT_GT(known.uneven, 0);
    const double reach = StudentQuantile(known.degrees_of_freedom, kIntervalLevel);
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
  const Eigen::MatrixXd cofactor = (A.transpose() * A).inverse();
  const Uncertainty known = CovarianceOf({.rows = RowsFrom([&] { return A; }),
                                          .cofactor = cofactor,
                                          .residual = residual,
                                          .selection = warmjoint::AllOf(400)});
  EXPECT_EQ(known.noise.order(), 0);
  EXPECT_EQ(known.degrees_of_freedom, 398);
  EXPECT_EQ(known.covariance, residual.squaredNorm() / 398 * cofactor);
  EXPECT_EQ(ColourOf(known.noise), "");
}

constexpr int kSamples = 20;  // of a segment

Selection Segments(int count) {
  const Eigen::Index n = count * kSamples;
  Selection selection = warmjoint::AllOf(n);
  for (int g = 0; g < count; ++g) {
    selection.segments.push_back({g * kSamples, (g + 1) * kSamples, 1});
  }
  return selection;
}

/// How often intervals of a level and of a slope over speed hold the truth, in a thousand fits of
/// noise whose part in common to a segment has a deviation.
Eigen::Array2d CoverageOfSegments(int count, double in_common) {
  constexpr int kFits = 1000;
  const Selection selection = Segments(count);
  const Eigen::Index n = selection.count();
  Eigen::MatrixXd A(n, 2);
  RandomStream random({7, static_cast<std::uint64_t>(count)}, Stream::test);
  for (int g = 0; g < count; ++g) {
    const double speed = 0.1 + 0.9 * (g + 0.5) / count;
    A.middleRows(g * kSamples, kSamples).rowwise() = Eigen::RowVector2d(1, speed);
  }
  const Eigen::MatrixXd cofactor = Cofactor(A.transpose() * A);
  Eigen::Array2d held(0, 0);
  for (int fit = 0; fit < kFits; ++fit) {
    Eigen::VectorXd noise(n);
    for (int g = 0; g < count; ++g) {
      const double common = in_common * random.Normal();
      for (int i = 0; i < kSamples; ++i) noise[g * kSamples + i] = common + random.Normal();
    }
    const Eigen::Vector2d x = cofactor * A.transpose() * noise;
    const Eigen::VectorXd residual = noise - A * x;
    const Uncertainty known = CovarianceOf({.rows = RowsFrom([&] { return A; }),
                                            .cofactor = cofactor,
                                            .residual = residual,
                                            .selection = selection});
    for (int j = 0; j < 2; ++j) {
      const double reach =
          StudentQuantile(known.DegreesOfFreedom(j), kIntervalLevel) * known.Deviation(j);
      held[j] += (std::abs(x[j]) <= reach) / static_cast<double>(kFits);
    }
  }
  return held;
}

TEST(FewSegments, LeaveIntervalsThatHoldTheTruth) {
  // standard error of 95 % in a thousand: 0.7 %, of which three; noise in common to a segment makes
  // the variance scatter less than white noise, for which its degrees of freedom are counted
  for (const int count : {3, 4, 6, 9}) {
    const Eigen::Array2d white = CoverageOfSegments(count, 0),
                         common = CoverageOfSegments(count, 2);
    for (int j = 0; j < 2; ++j) {
      EXPECT_NEAR(white[j], 0.95, 0.021) << count << " segments, " << j;
      EXPECT_GE(common[j], 0.95 - 0.021) << count << " segments, " << j;
    }
  }
}

Selection Keep(Eigen::Index n, Eigen::Index gap) {
  Selection selection = warmjoint::AllOf(n);
  for (Eigen::Index i = 0; gap > 0 && i < n; ++i) selection.keep[i] = i / gap % 2 == 0;
  return selection;
}

TEST(NoiseModel, TakesWhiteNoiseForWhite) {
  int white = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    white += FitNoise(Coloured(3600, 0, seed), Keep(3600, 0)).order() == 0;
  }
  // BIC takes one order of 6 for real when its log-likelihood is ln(n)/2 = 4 above chance: 2.5 %
  EXPECT_GE(white, 92);
}

TEST(NoiseModel, ScattersWhiteNoiseWithoutColour) {
  // by blocks of rows, of samples with a gap
  Selection selection = Keep(700, 0);
  selection.keep.segment(100, 50) = false;
  const Eigen::Index n = selection.count();
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(n, 3);
  NoiseModel white;
  white.variance = white.innovation = 0.7;
  const auto rows = [&](Eigen::Index first, Eigen::Index last) -> Eigen::MatrixXd {
    return A.middleRows(first, last - first);
  };
  const Eigen::MatrixXd expected = 0.7 * A.transpose() * A;
  EXPECT_TRUE(ScatterThrough(white, rows, 3, selection).isApprox(expected, 1e-12));
}

TEST(NoiseModel, FindsTheColourOfAutoregressiveNoiseAcrossGaps) {
  for (Eigen::Index gap : {0, 300}) {
    const Selection selection = Keep(20000, gap);
    const NoiseModel noise = FitNoise(Kept(Coloured(20000, 0.9, 7), selection), selection);
    ASSERT_GE(noise.order(), 1) << gap;
    // standard deviation of a pole: sqrt((1 - 0.81) / 10000) = 0.0044
    EXPECT_NEAR(noise.correlation, 0.9, 4 * 0.0044) << gap;
    EXPECT_NEAR(noise.coefficients[0], -0.9, 0.05) << gap;
    // (1 + 0.81) / (1 - 0.81), within what four deviations of the pole make of it
    EXPECT_NEAR(noise.variance_inflation, 9.5, 2.5) << gap;
  }
}

/// A level that was known beforehand to one standard error of the log's, beside a weight of +-1 in
/// turn: by hand its variance is s^2 / (n + n), of which a half comes from either.
Uncertainty Penalised(const WeightPrior& pull, const Eigen::MatrixXd& inverse,
                      const Eigen::MatrixXd& prior, const Eigen::MatrixXd& jacobian,
                      const Eigen::VectorXd& residual) {
  return CovarianceOf({.rows = RowsFrom([&] { return jacobian; }),
                       .cofactor = inverse,
                       .residual = residual,
                       .selection = warmjoint::AllOf(residual.size()),
                       .prior = prior,
                       .pull = pull});
}

TEST(PenalisedUncertainty, CountsWhatWasKnownBeforehandAsOneMoreMeasurement) {
  const Eigen::Index n = 20000;
  Eigen::MatrixXd jacobian(n, 2);
  Eigen::VectorXd residual(n);
  RandomStream random({1, 1}, Stream::torque_noise);
  for (Eigen::Index i = 0; i < n; ++i) {
    jacobian.row(i) << (i % 2 == 0 ? 1.0 : -1.0), 1.0;
    residual[i] = random.Normal();
  }
  const Eigen::MatrixXd gram = jacobian.transpose() * jacobian;
  Eigen::MatrixXd prior = Eigen::MatrixXd::Zero(2, 2);
  prior(1, 1) = static_cast<double>(n);
  Eigen::MatrixXd penalised = gram;
  penalised(0, 0) += 1;
  penalised(1, 1) += prior(1, 1);
  const Eigen::MatrixXd inverse = penalised.inverse();
  const Eigen::VectorXd weight = Eigen::VectorXd::Constant(1, 0.5);
  const Uncertainty known =
      Penalised({gram, 0, weight, 1, {false}}, inverse, prior, jacobian, residual);

  // to the scatter of the noise's variance, sqrt(2 / n) = 1 %, four times
  const double closed_form = 1.0 / (2.0 * double(n));
  EXPECT_NEAR(known.covariance(1, 1), closed_form, 0.04 * closed_form);
  EXPECT_NEAR(known.covariance(0, 1), 0, 0.01 * closed_form);
}

/// Two weights that the data know well and badly, and one that follows its neighbours; hardly any noise.
/// By hand: C = 1 / (g + s), B = s^2 g / (g + s)^2, L = g / (g + s), s_w^2 = sum B w^2 / sum B L^2.
TEST(PenalisedUncertainty, TakesTheWeightsVarianceFromThoseThatThePriorHoldsBack) {
  const Eigen::Index n = 3000;
  const double s = 10;
  const Eigen::Vector3d entries{1, 0.1, 0.1};
  const Eigen::Vector3d weight{1, 3, 100};
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(n, 3);
  Eigen::VectorXd residual(n);
  RandomStream random({1, 2}, Stream::torque_noise);
  for (Eigen::Index i = 0; i < n; ++i) {
    jacobian(i, i % 3) = entries[i % 3];
    residual[i] = 1e-6 * random.Normal();
  }
  const Eigen::MatrixXd gram = jacobian.transpose() * jacobian;
  const Eigen::Array3d g = gram.diagonal();  // 1000, 10, 10
  const Eigen::MatrixXd inverse = (1 / (g + s)).matrix().asDiagonal();
  const Uncertainty known =
      Penalised({gram, 0, weight, s, {false, false, true}}, inverse, {}, jacobian, residual);

  double above = 0, below = 0;
  for (const int k : {0, 1}) {
    const double b = s * s * g[k] / std::pow(g[k] + s, 2);
    above += b * weight[k] * weight[k];
    below += b * std::pow(g[k] / (g[k] + s), 2);
  }
  for (const int k : {0, 1}) {
    const double variance = above / below * std::pow(s / (g[k] + s), 2);
    EXPECT_NEAR(known.covariance(k, k), variance,
                1e-6 * variance);  // the noise is 1e-6 of the weights
  }
  EXPECT_LT(known.covariance(2, 2), 1e-12) << "it is not drawn from the prior";
}

}  // namespace
}  // namespace warmjoint
