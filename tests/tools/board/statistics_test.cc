#include "tools/board/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(Statistics, SummariseKnownSamples) {
  const Summary summary = Summarise(std::vector<double>({4, 1, 3, 2}));
  EXPECT_EQ(summary.median, 2.5);
  EXPECT_EQ(summary.q25, 1.75);
  EXPECT_EQ(summary.q75, 3.25);
  EXPECT_DOUBLE_EQ(summary.rms, std::sqrt(30.0 / 4));
}

TEST(Statistics, LeaveOutWhatIsNoNumber) {
  const Summary summary = Summarise(std::vector<double>({NAN, 2, NAN}));
  EXPECT_EQ(summary.median, 2);
  EXPECT_EQ(summary.rms, 2);
  EXPECT_TRUE(std::isnan(Summarise(std::vector<double>({NAN})).median));
  EXPECT_TRUE(std::isnan(Summarise(std::vector<double>({})).rms));
}

TEST(Statistics, QuantilesStandInfinities) {
  EXPECT_EQ(Quantile({1, kInfinite, kInfinite}, 0.5), kInfinite);
  EXPECT_EQ(Quantile({1, 2, kInfinite}, 0.5), 2);
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

TEST(MedianDifference, HasTheIntervalOfAllResamples) {
  const std::vector<double> values{0.3, -1, 2, 5, 0.7, -4};
  for (std::size_t n = 1; n <= values.size(); ++n) {
    const std::vector<double> some(values.begin(), values.begin() + static_cast<long>(n));
    const Difference difference = MedianDifference(some);
    EXPECT_EQ(difference.lower, ByCounting(some, 0.025)) << n;
    EXPECT_EQ(difference.upper, ByCounting(some, 0.975)) << n;
  }
}

TEST(MedianDifference, OfAMillionHasTheWidthOfTheAsymptoticInterval) {
  RandomStream random({2, 0}, Stream::test);
  const int n = 1000000;
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(random.Normal());
  const Difference difference = MedianDifference(values);
  // the median of n normal draws has the standard deviation sqrt(pi / (2 n)); the ends scatter by
  // some n^(-3/4) about their places, 3 % of the width
  const double width = 2 * 1.96 * std::sqrt(std::acos(-1) / 2 / n);
  EXPECT_NEAR(difference.upper - difference.lower, width, 0.1 * width);
}

TEST(MedianDifference, TakesInfinitiesAndNothing) {
  EXPECT_EQ(MedianDifference({kInfinite, kInfinite, 0}).median, kInfinite);
  EXPECT_TRUE(std::isnan(MedianDifference({}).median));
  EXPECT_TRUE(MedianDifference({0, 0}).tie());
}

}  // namespace
}  // namespace warmjoint
