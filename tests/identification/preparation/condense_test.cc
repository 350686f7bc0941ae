#include "identification/preparation/condense.h"

#include <gtest/gtest.h>

#include "identification/preparation/prepared_log.h"
#include "tests/support/warm_recording.h"

namespace warmjoint {
namespace {

LogView Steady() {
  const Measurements m =
      test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(3600, 1), 0, 1);
  return Prepare(m).steady();
}

TEST(Condense, LeavesAShortLogAsItIs) {
  const LogView all = Steady();
  EXPECT_EQ(Condense(all, 4000).view.measurements.size(), all.measurements.size());
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

}  // namespace
}  // namespace warmjoint
