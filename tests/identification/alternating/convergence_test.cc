#include "identification/alternating/convergence.h"

#include <gtest/gtest.h>

#include <cmath>

namespace warmjoint {
namespace {

/// x[i] = 1 + amplitude rate^i in both entries, the second ten times slower off.
std::vector<Eigen::VectorXd> Sequence(double amplitude, double rate, int count) {
  std::vector<Eigen::VectorXd> iterates;
  for (int i = 0; i < count; ++i) {
    const double distance = amplitude * std::pow(rate, i);
    iterates.push_back(Eigen::Vector2d(1 + distance, 1 - 0.1 * distance));
  }
  return iterates;
}

TEST(Convergence, ExtrapolatesALinearlyConvergentSequence) {
  const Convergence judged = JudgeConvergence(Sequence(2, 0.97, 50));
  // 1e-9: differences of numbers near 1 keep 1e-16 / (change 0.01) of their digits
  EXPECT_NEAR(judged.rate, 0.97, 1e-9);
  EXPECT_NEAR(judged.remaining, 2 * std::pow(0.97, 49), 1e-9);
}

TEST(Convergence, IsNeverThereWhereTheSequenceRuns) {
  EXPECT_TRUE(std::isinf(JudgeConvergence(Sequence(0.1, 1.02, 50)).remaining));
  EXPECT_TRUE(std::isinf(JudgeConvergence(Sequence(1, 0.5, 2)).remaining));
}

TEST(Convergence, HasArrivedWhereNothingMoves) {
  EXPECT_EQ(JudgeConvergence(Sequence(1, 0.1, 40)).remaining, 0);
}

}  // namespace
}  // namespace warmjoint
