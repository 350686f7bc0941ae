#include "identification/identifiers/condense.h"

#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>

#include <iterator>
#include <vector>

#include "models/recording/measurements.h"
#include "tests/support/warm_recording.h"

namespace warmjoint {
namespace {

LogView Steady() {
  const Measurements m =
      test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(3600, 1), 0, 1);
  return Prepare(m).constant_speed();
}

TEST(Condense, MakesRowsOfOneSegment) {
  const LogView all = Steady();
  const LogView some = Condense(all, 900).view;
  EXPECT_LT(some.selection.count(), all.selection.count() / 3);
  ASSERT_EQ(some.selection.segments.size(), all.selection.segments.size());
  for (const Segment& one : some.selection.segments) {
    for (Eigen::Index i = one.begin; i < one.end; ++i) {
      EXPECT_NEAR(some.measurements.velocity[i], one.velocity, 1e-9);
    }
  }
}

TEST(Condense, KeepsTheWayAndTheTime) {
  const LogView all = Steady();
  const auto [some, first] = Condense(all, 900);
  const auto& a = all.measurements;
  const auto& b = some.measurements;
  for (Eigen::Index i = 1; i < b.size(); ++i) EXPECT_GT(b.time[i], b.time[i - 1]);
  EXPECT_NEAR(b.time[b.size() - 1], a.time[a.size() - 1], 4);

  // a row stands among its samples
  ASSERT_EQ(first.size(), static_cast<size_t>(b.size()) + 1);
  EXPECT_EQ(first.back(), a.size());
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    EXPECT_GE(b.time[i], a.time[first[static_cast<size_t>(i)]]);
    EXPECT_LE(b.time[i], a.time[first[static_cast<size_t>(i) + 1] - 1]);
  }
}

/// Five holds of 10 s, then one of 100 s: the times between their rows look like gaps.
TEST(Condense, KeepsTheGapsOfTheSamples) {
  std::vector<double> speeds;
  for (int hold = 0; hold < 120; ++hold) {
    const double speed = (hold % 2 == 0 ? 1 : -1) * (0.2 + 0.1 * (hold % 7));
    speeds.insert(speeds.end(), hold % 6 == 5 ? 100 : 10, speed);
  }
  const Eigen::VectorXd velocity = Eigen::VectorXd::Map(speeds.data(), std::ssize(speeds));
  Measurements m = test::RecordFriction(test::TableOne(), 1, velocity, 0, 1);
  LogView some = Condense(Prepare(m).constant_speed(), 30).view;
  EXPECT_FALSE(GapsOf(some.measurements.time).empty());
  ASSERT_TRUE(some.measurements.gaps);
  EXPECT_TRUE(some.measurements.gaps->empty());

  // a clock that stood still for a minute
  m.time.tail(1500).array() += 60;
  some = Condense(Prepare(m).constant_speed(), 30).view;
  ASSERT_EQ(some.measurements.gaps->size(), 1u);
  const LogGap& gap = some.measurements.gaps->front();
  EXPECT_EQ(gap.length, 61);
  EXPECT_GT(some.measurements.time[gap.behind], m.time[m.size() - 1500]);
  EXPECT_LT(some.measurements.time[gap.behind - 1], m.time[m.size() - 1501]);
}

}  // namespace
}  // namespace warmjoint
