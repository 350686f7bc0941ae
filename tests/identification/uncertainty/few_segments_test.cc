#include "identification/uncertainty/few_segments.h"

#include <gtest/gtest.h>

#include <cmath>

#include "identification/linear/least_squares.h"
#include "identification/uncertainty/tails.h"
#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

constexpr int kSamples = 20;  // of a segment

Selection Segments(int count) {
  const Eigen::Index n = count * kSamples;
  Selection selection{Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(n, true), {}};
  for (int g = 0; g < count; ++g) {
    selection.segments.push_back({g * kSamples, (g + 1) * kSamples, 1});
  }
  return selection;
}

/// How often intervals of a level and of a slope over speed hold the truth, in a thousand fits of
/// noise whose part in common to a segment has a deviation.
Eigen::Array2d Coverage(int count, double in_common) {
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
    Uncertainty known = JudgeUncertainty(A, cofactor, residual, selection);
    CountSegments(A, cofactor, residual, selection, known);
    for (int j = 0; j < 2; ++j) {
      const double reach = StudentQuantile(known.Freedom(j), kIntervalLevel) * known.Deviation(j);
      held[j] += (std::abs(x[j]) <= reach) / static_cast<double>(kFits);
    }
  }
  return held;
}

TEST(FewSegments, LeaveIntervalsThatHoldTheTruth) {
  // standard error of 95 % in a thousand: 0.7 %, of which three; noise in common to a segment makes
  // the variance scatter less than white noise, for which its degrees of freedom are counted
  for (const int count : {3, 4, 6, 9}) {
    const Eigen::Array2d white = Coverage(count, 0), common = Coverage(count, 2);
    for (int j = 0; j < 2; ++j) {
      EXPECT_NEAR(white[j], 0.95, 0.021) << count << " segments, " << j;
      EXPECT_GE(common[j], 0.95 - 0.021) << count << " segments, " << j;
    }
  }
}

}  // namespace
}  // namespace warmjoint
