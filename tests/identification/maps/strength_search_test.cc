#include "identification/maps/strength_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "identification/ridge/local_ridge.h"
#include "models/foundation/random_stream.h"
#include "tests/support/cross_validate.h"

namespace warmjoint {
namespace {

constexpr Eigen::Index kKernels = 12, kParts = 5, kRows = 40;

/// Parts of y = A x + noise, whose weights are of size 1, behind one free column.
std::vector<NormalEquations> Parts(double noise, std::uint64_t seed) {
  RandomStream random({seed, 0}, Stream::motion);
  Eigen::VectorXd x(1 + kKernels);
  for (double& value : x) value = random.Normal();
  std::vector<NormalEquations> parts;
  for (Eigen::Index i = 0; i < kParts; ++i) {
    Eigen::MatrixXd A(kRows, x.size());
    for (double& value : A.reshaped()) value = random.Normal();
    Eigen::VectorXd y = A * x;
    for (double& value : y) value += noise * random.Normal();
    parts.emplace_back(x.size());
    parts.back().Add(A, y);
  }
  return parts;
}

NormalEquations Sum(const std::vector<NormalEquations>& parts) {
  NormalEquations all = parts[0];
  for (size_t i = 1; i < parts.size(); ++i) all = all.Plus(parts[i]);
  return all;
}

const StrengthTrial& Least(const std::vector<StrengthTrial>& trials) {
  return *std::ranges::min_element(trials, {},
                                   [](const StrengthTrial& one) { return one.squares.sum(); });
}

TEST(SearchStrengths, FindsTheLeastErrorOfAll) {
  // from where the prior hardly matters to where it takes all
  for (const double noise : {0.1, 1.0, 3.0, 10.0, 100.0}) {
    const auto parts = Parts(noise, 3);
    const NormalEquations all = Sum(parts);
    const std::vector<double> strengths = Strengths(all, 1);
    const Eigen::VectorXd errors = test::CrossValidate(parts, 1, strengths);
    Eigen::Index best = 0;
    errors.minCoeff(&best);
    const auto trials = SearchStrengths(parts, all, 1, {});
    EXPECT_EQ(Least(trials).strength, strengths[static_cast<size_t>(best)]) << noise;
    EXPECT_LT(trials.size(), strengths.size());
    EXPECT_TRUE(std::ranges::is_sorted(trials, {}, &StrengthTrial::strength));
  }
}

TEST(SearchStrengths, LooksAtStrongerOnesAsLongAsTheyAreAsGood) {
  const auto parts = Parts(10, 4);
  const auto trials = SearchStrengths(parts, Sum(parts), 1, {});
  const Eigen::ArrayXd least = Least(trials).squares;
  const auto as_good = [&](const StrengthTrial& one) { return AsGood(one.squares, least); };
  const auto last = std::find_if(trials.rbegin(), trials.rend(), as_good);
  ASSERT_NE(last, trials.rend());
  const std::vector<double> strengths = Strengths(Sum(parts), 1);
  if (last->strength == strengths.back()) return;

  // the next stronger one was looked at, and is worse
  EXPECT_NE(last, trials.rbegin());
  EXPECT_NEAR(std::prev(last)->strength / last->strength, std::sqrt(10.0), 1e-9);
}

TEST(SearchStrengths, TellsWhichLeaveParametersAboveTheirBounds) {
  const auto parts = Parts(1, 5);
  for (const StrengthTrial& one : SearchStrengths(parts, Sum(parts), 1, {1e3})) {
    EXPECT_FALSE(one.possible);
  }
  for (const StrengthTrial& one : SearchStrengths(parts, Sum(parts), 1, {-1e3})) {
    EXPECT_TRUE(one.possible);
  }
}

}  // namespace
}  // namespace warmjoint
