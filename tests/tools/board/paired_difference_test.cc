#include "tools/board/paired_difference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

NumberColumn Column(const std::vector<double>& values) {
  NumberColumn column;
  for (const double value : values) column.Add(value);
  return column;
}

Difference Between(const std::vector<double>& a, const std::vector<double>& b) {
  return PairedDifference(Column(a), Column(b));
}

/// The smallest value that the lower median of a resample does not exceed with probability `level`: all
/// n^n resamples of the values, counted.
double ByCounting(std::vector<double> values, double level) {
  const std::size_t n = values.size();
  std::vector<double> medians;
  std::vector<std::size_t> drawn(n, 0);
  for (bool more = true; more;) {
    std::vector<double> sample;
    for (const std::size_t i : drawn) sample.push_back(values[i]);
    std::sort(sample.begin(), sample.end());
    medians.push_back(sample[(n - 1) / 2]);
    // the next one, as an odometer counts
    std::size_t digit = 0;
    while (digit < n && ++drawn[digit] == n) drawn[digit++] = 0;
    more = digit < n;
  }
  std::sort(medians.begin(), medians.end());
  const double count = std::ceil(level * static_cast<double>(medians.size()));
  return medians[static_cast<std::size_t>(count) - 1];
}

TEST(PairedDifference, OfEqualsIsATie) {
  const Difference difference = Between({1, 2, kInfinite}, {1, 2, kInfinite});
  EXPECT_EQ(difference.median, 0);
  EXPECT_TRUE(difference.tie());
}

TEST(PairedDifference, HasTheIntervalOfAllResamples) {
  const std::vector<double> values{0.3, -1, 2, 5, 0.7, -4};
  for (std::size_t n = 1; n <= values.size(); ++n) {
    const std::vector<double> some(values.begin(), values.begin() + static_cast<long>(n));
    const Difference difference = Between(some, std::vector<double>(n, 0));
    EXPECT_EQ(difference.lower, ByCounting(some, 0.025)) << n;
    EXPECT_EQ(difference.upper, ByCounting(some, 0.975)) << n;
  }
}

TEST(PairedDifference, FindsASmallShiftUnderACommonScatter) {
  RandomStream random({1, 0}, Stream::test);
  std::vector<double> a, b;
  for (int i = 0; i < 100; ++i) {
    const double scatter = 10 * random.Normal();
    b.push_back(scatter);
    a.push_back(scatter + 0.5 + 0.1 * random.Normal());
  }
  const Difference difference = Between(a, b);
  EXPECT_FALSE(difference.tie());
  // the median of 100 draws of deviation 0.1 scatters by 0.0125; four of these
  EXPECT_NEAR(difference.median, 0.5, 0.05);
  EXPECT_LT(difference.lower, difference.median);
  EXPECT_GT(difference.upper, difference.median);
}

TEST(PairedDifference, OfAMillionPairsHasTheWidthOfTheAsymptoticInterval) {
  RandomStream random({2, 0}, Stream::test);
  NumberColumn a, b;
  const int n = 1000000;
  for (int i = 0; i < n; ++i) {
    b.Add(0);
    a.Add(random.Normal());
  }
  const Difference difference = PairedDifference(a, b);
  // the median of n normal draws has the standard deviation sqrt(pi / (2 n)); the ends scatter by
  // some n^(-3/4) about their places, 3 % of the width
  const double width = 2 * 1.96 * std::sqrt(std::acos(-1) / 2 / n);
  EXPECT_NEAR(difference.upper - difference.lower, width, 0.1 * width);
}

TEST(PairedDifference, FailuresAreInfinitelyFarBehind) {
  const Difference difference = Between({kInfinite, kInfinite, 1}, {1, 1, 1});
  EXPECT_EQ(difference.median, kInfinite);
  EXPECT_TRUE(std::isnan(Between({}, {}).median));
}

}  // namespace
}  // namespace warmjoint
