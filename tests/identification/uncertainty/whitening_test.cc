#include "identification/uncertainty/whitening.h"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "identification/fit/fit_data.h"
#include "tests/support/coloured_noise.h"

namespace warmjoint {
namespace {

using test::Coloured;

using ::testing::ElementsAre;

/// AR(2) noise e[i] = 1.2 e[i-1] - 0.4 e[i-2] + w, w of variance 1, by the Yule-Walker equations.
NoiseModel SecondOrder() {
  const double one = 1.2 / 1.4, two = 1.2 * one - 0.4;
  NoiseModel noise;
  noise.coefficients = Eigen::Vector2d(-1.2, 0.4);
  noise.innovation = 1;
  noise.variance = 1 / (1 - 1.2 * one + 0.4 * two);
  noise.covariances = noise.variance * Eigen::Vector3d(1, one, two);
  return noise;
}

NoiseModel FirstOrder(double pole) {
  NoiseModel noise;
  noise.coefficients = Eigen::VectorXd::Constant(1, -pole);
  noise.variance = 4;
  noise.covariances = Eigen::Vector2d(4, 4 * pole);
  noise.innovation = 4 * (1 - pole * pole);
  return noise;
}

/// R, written out.
Eigen::MatrixXd CovarianceAt(const NoiseModel& noise, const std::vector<Eigen::Index>& places) {
  const auto n = static_cast<Eigen::Index>(places.size());
  const Eigen::VectorXd r = CovariancesOf(noise, places.back());
  Eigen::MatrixXd R(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      R(i, j) = r[std::abs(places[static_cast<size_t>(i)] - places[static_cast<size_t>(j)])];
    }
  }
  return R;
}

/// How far W R W^T is from s^2 times the identity, of s^2.
double LeftOfColour(const NoiseModel& noise, const std::vector<Eigen::Index>& places) {
  const auto n = static_cast<Eigen::Index>(places.size());
  const Eigen::MatrixXd W = Whitening(noise, places).Of(Eigen::MatrixXd::Identity(n, n));
  const Eigen::MatrixXd white = W * CovarianceAt(noise, places) * W.transpose() / noise.innovation;
  return (white - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff();
}

/// n samples 0.1 s apart, that turn every twentieth.
Measurements Log(Eigen::Index n) {
  Measurements m;
  m.velocity.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) m.velocity[i] = i / 20 % 2 == 0 ? 1 : -1;
  m.time = 0.1 * Eigen::VectorXd::LinSpaced(n, 0, static_cast<double>(n - 1));
  return m;
}

TEST(Whitening, MakesNoiseOfNeighboursWhite) {
  // 1e-12: rounding of a few products of numbers near 4
  EXPECT_LT(LeftOfColour(SecondOrder(), {0, 1, 2, 3, 4, 5, 6, 7}), 1e-12);
  EXPECT_LT(LeftOfColour(FirstOrder(0.9), {0, 1, 2, 3, 4, 5, 6, 7}), 1e-12);
}

TEST(Whitening, IsExactAcrossGapsForNoiseOfFirstOrder) {
  EXPECT_LT(LeftOfColour(FirstOrder(0.9), {0, 1, 2, 7, 8, 20, 21, 23}), 1e-12);
}

TEST(Whitening, LeavesLittleColourBehindGapsForNoiseOfSecondOrder) {
  // two rows predict, where more would a little: the state behind a gap is not known exactly
  EXPECT_LT(LeftOfColour(SecondOrder(), {0, 1, 2, 3, 7, 8, 9, 10}), 0.1);
}

TEST(Whitening, PlacesSamplesByTheirTime) {
  // samples that were put in between, gaps, the start of a recording
  LogSamples m(Log(8));
  m.time << 0, 0.1, 0.15, 0.2, 0.7, 0.8, 0.9, 1.0;
  Selection selection = warmjoint::AllOf(8);
  selection.keep[2] = false;
  EXPECT_THAT(PlacesInTime(m, selection), ElementsAre(0, 1, 2, 7, 8, 9, 10));
  m.further_starts = {6};
  EXPECT_THAT(PlacesInTime(m, selection), ElementsAre(0, 1, 2, 7, 8, 1008, 1009));
  // and each sample has a place of its own
  m.time << 0, 0.1, 0.15, 0.2, 0.21, 0.3, 1e9, 1e9 + 0.1;
  m.further_starts.clear();
  EXPECT_THAT(PlacesInTime(m, selection), ElementsAre(0, 1, 2, 3, 4, 1004, 1005));
}

TEST(Whitening, IsForNoiseThatIsColouredBeyondDoubt) {
  const LogSamples m(Log(1000));
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    // by chance in one of two million
    EXPECT_FALSE(WhiteningFor(Coloured(1000, 0, seed), m, warmjoint::AllOf(1000))) << seed;
  }
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    // n ln(1 / (1 - 0.09)) = 94, where 5 deviations and 60 orders ask for 33 of one order
    EXPECT_TRUE(WhiteningFor(Coloured(1000, 0.3, seed), m, warmjoint::AllOf(1000))) << seed;
  }
}

}  // namespace
}  // namespace warmjoint
