#include "models/foundation/random_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace warmjoint {
namespace {

constexpr int kDraws = 200'000;

TEST(RandomStream, MatchesPhiloxOfTheSameCounter) {
  // first block of the generator itself: an independent path to the same bits
  const auto block = r123::Philox4x32()({{0, 1, 3, 0}}, {{7, 0}});
  const std::uint64_t bits = (std::uint64_t{block[0]} << 32) | block[1];
  RandomStream stream({7, 3}, Stream::motion);
  EXPECT_EQ(stream.Uniform(), static_cast<double>(bits >> 11) * 0x1.0p-53);
}

TEST(RandomStream, DiffersBySeedRealizationAndStream) {
  std::set<double> first;
  for (std::uint64_t seed : {0ull, 1ull, 1ull << 40}) {
    for (std::uint64_t realization : {0ull, 1ull, 1ull << 40}) {
      for (Stream stream : {Stream::truth, Stream::motion, Stream::start}) {
        first.insert(RandomStream({seed, realization}, stream).Uniform());
      }
    }
  }
  EXPECT_EQ(first.size(), 27u);
}

TEST(RandomStream, NormalHasMomentsOfTheNormal) {
  RandomStream stream({11, 0}, Stream::test);
  std::array<double, 4> moment{};
  for (int i = 0; i < kDraws; ++i) {
    const double x = stream.Normal();
    for (size_t k = 0; k < 4; ++k) moment[k] += std::pow(x, static_cast<int>(k) + 1) / kDraws;
  }
  // five standard errors of each moment: sqrt(var(x^k) / n), var = 1, 2, 15, 96
  const double unit = 5 / std::sqrt(kDraws);
  EXPECT_NEAR(moment[0], 0, unit * 1);
  EXPECT_NEAR(moment[1], 1, unit * std::sqrt(2));
  EXPECT_NEAR(moment[2], 0, unit * std::sqrt(15));
  EXPECT_NEAR(moment[3], 3, unit * std::sqrt(96));
}

TEST(RandomStream, NeighbouringDrawsAreUncorrelated) {
  RandomStream stream({12, 0}, Stream::test);
  double sum = 0;
  double last = stream.Normal();
  for (int i = 0; i < kDraws; ++i) {
    const double next = stream.Normal();
    sum += last * next;
    last = next;
  }
  // five standard errors: each product has variance 1
  EXPECT_NEAR(sum / kDraws, 0, 5 / std::sqrt(kDraws));
}

TEST(RandomStream, BelowIsUniform) {
  RandomStream stream({13, 0}, Stream::test);
  std::vector<int> count(7);
  for (int i = 0; i < kDraws; ++i) ++count[stream.Below(7)];
  double chi_square = 0;
  const double expected = kDraws / 7.0;
  for (int n : count) chi_square += (n - expected) * (n - expected) / expected;
  // 6 degrees of freedom: exceeded with probability 1e-6
  EXPECT_LT(chi_square, 38.3);
}

TEST(StartStream, DrawsUniformly) {
  // mean of a million: 3 standard deviations of 4/sqrt(12 million)
  StartStream stream(StartKey{{1, 2, 3, 4}});
  double sum = 0, least = 10, greatest = -10;
  for (int i = 0; i < 1000000; ++i) {
    const double x = stream.Uniform(-1, 3);
    sum += x;
    least = std::min(least, x);
    greatest = std::max(greatest, x);
  }
  EXPECT_NEAR(sum / 1e6, 1, 3 * 4 / std::sqrt(12 * 1e6));
  EXPECT_GE(least, -1);
  EXPECT_LT(greatest, 3);
}

}  // namespace
}  // namespace warmjoint
