#include "tools/board/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

NumberColumn Column(std::initializer_list<double> values) {
  NumberColumn column;
  for (const double value : values) column.Add(value);
  return column;
}

TEST(Statistics, SummariseKnownSamples) {
  const Summary summary = Summarise(Column({4, 1, 3, 2}));
  EXPECT_EQ(summary.median, 2.5);
  EXPECT_EQ(summary.q25, 1.75);
  EXPECT_EQ(summary.q75, 3.25);
  EXPECT_DOUBLE_EQ(summary.rms, std::sqrt(30.0 / 4));
}

TEST(Statistics, LeaveOutWhatIsNoNumber) {
  const Summary summary = Summarise(Column({NAN, 2, NAN}));
  EXPECT_EQ(summary.median, 2);
  EXPECT_EQ(summary.rms, 2);
  EXPECT_TRUE(std::isnan(Summarise(Column({NAN})).median));
  EXPECT_TRUE(std::isnan(Summarise(Column({})).rms));
}

TEST(Statistics, QuantilesStandInfinities) {
  EXPECT_EQ(Quantile({1, kInfinite, kInfinite}, 0.5), kInfinite);
  EXPECT_EQ(Quantile({1, 2, kInfinite}, 0.5), 2);
}

/// Numbers of all signs and sizes, with infinities and NaN among them.
double Mixed(RandomStream& random, int i) {
  if (i % 101 == 0) return kInfinite;
  if (i % 103 == 0) return -kInfinite;
  if (i % 107 == 0) return std::nan("");
  if (i % 5 == 0) return 0;
  return random.Normal() * std::exp(5 * random.Normal());
}

TEST(Ascending, FindsTheNumbersOfALongColumnThatSortingFinds) {
  RandomStream random({3, 0}, Stream::test);
  NumberColumn column;
  std::vector<double> sorted;
  for (int i = 0; i < 200000; ++i) {
    const double value = Mixed(random, i);
    column.Add(value);
    if (!std::isnan(value)) sorted.push_back(value);
  }
  std::sort(sorted.begin(), sorted.end());

  const Ascending ascending(column);
  ASSERT_EQ(ascending.size(), sorted.size());
  for (std::size_t i = 0; i < sorted.size(); i += 13007) EXPECT_EQ(ascending[i], sorted[i]) << i;
  EXPECT_EQ(ascending[sorted.size() - 1], sorted.back());
  for (const double share : {0.0, 0.025, 0.25, 0.5, 0.75, 1.0}) {
    EXPECT_EQ(ascending.Quantile(share), Quantile(sorted, share)) << share;
  }
}

TEST(Ascending, TellsNumbersApartInTheirLastBit) {
  // more equal ones than are sorted in memory, beside their neighbours
  const double middle = 1.5, next = std::nextafter(middle, 2), before = std::nextafter(middle, 0);
  NumberColumn column;
  for (int i = 0; i < 100000; ++i) column.Add(middle);
  for (int i = 0; i < 10; ++i) column.Add(next);
  for (int i = 0; i < 10; ++i) column.Add(before);
  const Ascending ascending(column);
  EXPECT_EQ(ascending[9], before);
  EXPECT_EQ(ascending[10], middle);
  EXPECT_EQ(ascending[100009], middle);
  EXPECT_EQ(ascending[100010], next);
}

}  // namespace
}  // namespace warmjoint
