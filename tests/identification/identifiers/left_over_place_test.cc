#include "identification/identifiers/left_over_place.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

constexpr Eigen::Index kSamples = 3000;

/// A joint that travels from -1 to 1 and back 20 times, its motor 10 times as far.
MapPoints Travel() {
  MapPoints points = MapPoints::Zero(kSamples, 5);
  for (Eigen::Index i = 0; i < kSamples; ++i) {
    const double turn = std::fmod(20.0 * static_cast<double>(i) / kSamples, 1.0);
    const double position = turn < 0.5 ? 4 * turn - 1 : 3 - 4 * turn;
    points.row(i) << position, 10 * position, turn < 0.5 ? 1 : -1, 0, 0;
  }
  return points;
}

Eigen::VectorXd Noise(std::uint64_t seed) {
  RandomStream random({seed, 0}, Stream::test);
  Eigen::VectorXd noise(kSamples);
  for (double& one : noise) one = random.Normal();
  return noise;
}

/// How many of 100 residuals hold more than chance would leave, with a wave of so many deviations.
/// wave: of the row
template <typename Wave>
int Seen(double size, const Wave& wave) {
  const MapPoints points = Travel();
  int seen = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Eigen::VectorXd residual = Noise(seed);
    for (Eigen::Index i = 0; i < kSamples; ++i) residual[i] += size * wave(points.row(i));
    seen += LeavesOverPlace(residual, points);
  }
  return seen;
}

TEST(LeavesOverPlace, SeesLittleInNoise) {
  // two sets of six widths that share their samples, each above two deviations in some 3 %: at most 35 %
  EXPECT_LE(Seen(0, [](const auto&) { return 0.0; }), 35);
}

// a wave of a quarter of the noise holds 3000 / 32 = 94 in units of the noise's variance: six
// deviations of means over 32 bins
TEST(LeavesOverPlace, SeesAWaveOverTheJoint) {
  EXPECT_EQ(Seen(0.25, [](const auto& row) { return std::sin(6 * row[0]); }), 100);
}

TEST(LeavesOverPlace, SeesAWaveOfOneDirectionAgainstTheOther) {
  EXPECT_EQ(Seen(0.25, [](const auto& row) { return row[2] * std::sin(6 * row[0]); }), 100);
}

TEST(LeavesOverPlace, SeesAWaveOverTheMotorsTurn) {
  EXPECT_EQ(Seen(0.25, [](const auto& row) { return std::sin(3 * row[1]); }), 100);
}

TEST(LeavesOverPlace, SaysNoWhereThereAreNoPlaces) {
  EXPECT_FALSE(LeavesOverPlace(Noise(1), MapPoints::Zero(kSamples, 5)));
}

}  // namespace
}  // namespace warmjoint
