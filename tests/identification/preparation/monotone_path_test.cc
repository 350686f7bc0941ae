#include "identification/preparation/monotone_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

using Eigen::VectorXd;

/// Samples a second apart.
VectorXd Monotone(const VectorXd& position, double hysteresis) {
  const auto n = static_cast<double>(position.size());
  return MonotonePath(VectorXd::LinSpaced(position.size(), 0, n - 1), position, hysteresis);
}

double PathOf(const VectorXd& p) {
  return (p.tail(p.size() - 1) - p.head(p.size() - 1)).cwiseAbs().sum();
}

TEST(MonotonePath, LeavesAWayWithoutNoiseAsItIs) {
  VectorXd way(7);
  way << 0, 1, 3, 4, 2, -1, 0.5;
  EXPECT_EQ(Monotone(way, 0.3), way);
}

TEST(MonotonePath, LeadsThroughTheMiddleOfWhatLeadsBackWithinTheHysteresis) {
  VectorXd way(5), pooled(5);
  way << 0, 2, 1, 3, 4;
  pooled << 0, 1, 2, 3, 4;
  EXPECT_EQ(Monotone(way, 1.5), pooled);
  EXPECT_EQ(Monotone(way, 0.5), way) << "it turned round";
}

TEST(MonotonePath, TakesTheNoiseOutOfThePath) {
  // there and back, 10 rad each, with noise as large as a step
  const Eigen::Index n = 2000;
  RandomStream random({1, 1}, Stream::test);
  VectorXd noisy(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    noisy[i] = 10 - std::abs(10 - 20.0 * static_cast<double>(i) / (n - 1)) + 0.01 * random.Normal();
  }
  EXPECT_GT(PathOf(noisy), 25);
  // what is left lies at the two ends and at the turn: two deviations each at most, mostly
  EXPECT_NEAR(PathOf(Monotone(noisy, 0.27)), 20, 0.1);
}

TEST(MonotonePath, KeepsARestWithDitherStill) {
  VectorXd rest(6);
  rest << 0, 1, 0, 1, 0, 1;
  EXPECT_LE(PathOf(Monotone(rest, 3)), 1);
}

}  // namespace
}  // namespace warmjoint
