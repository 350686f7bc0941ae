#include "identification/preparation/split_at_switches.h"

#include <gtest/gtest.h>

#include <cmath>

#include "identification/preparation/select.h"

namespace warmjoint {
namespace {

/// Speeds that switch at given times, logged every second. [v, until] in turn
struct Piece {
  double velocity;  // rad/s
  double until;     // s
};

Measurements Log(const std::vector<Piece>& pieces) {
  Measurements m;
  const auto n = static_cast<Eigen::Index>(pieces.back().until);
  m.time = Eigen::VectorXd::LinSpaced(n, 0, static_cast<double>(n - 1));
  m.position.resize(n);
  m.velocity.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    double position = 3, from = 0;
    for (const auto& [velocity, until] : pieces) {
      const double t = m.time[i];
      if (t >= from && t < until) m.velocity[i] = velocity;
      position += velocity * std::clamp(t - from, 0.0, until - from);
      from = until;
    }
    m.position[i] = position;
  }
  m.torque = 10 * m.velocity;
  return m;
}

double Path(const Measurements& m) {
  double path = 0;
  for (Eigen::Index n = 0; n + 1 < m.size(); ++n) {
    path += std::abs(m.velocity[n]) * (m.time[n + 1] - m.time[n]);
  }
  return path;
}

Selection All(const Measurements& m) { return SelectMoving(m); }

TEST(SplitAtSwitches, PutsASampleWhereTheSpeedSwitched) {
  const Measurements m = Log({{0.5, 4.3}, {-1, 8.75}, {-0.25, 12}});
  const auto split = SplitAtSwitches(m, All(m));
  ASSERT_TRUE(split);
  ASSERT_EQ(split->measurements.size(), 14);
  // positions are exact to rounding: 1e-12 of a second
  EXPECT_NEAR(split->measurements.time[5], 4.3, 1e-12);
  EXPECT_EQ(split->measurements.velocity[5], -1);
  EXPECT_EQ(split->measurements.torque[5], -10);
  EXPECT_NEAR(split->measurements.position[5], 3 + 0.5 * 4.3, 1e-12);
  EXPECT_NEAR(split->measurements.time[10], 8.75, 1e-12);
  EXPECT_FALSE(split->selection.keep[5] || split->selection.keep[10]);
  EXPECT_EQ(split->selection.count(), 12);

  // held until the next sample, the speeds give the path that was travelled
  EXPECT_NEAR(Path(split->measurements), 0.5 * 4.3 + 1 * 4.45 + 0.25 * 2.25, 1e-12);
}

TEST(SplitAtSwitches, LeavesALogAloneWhoseSamplesShowTheSwitches) {
  const Measurements m = Log({{0.5, 4}, {-1, 8}, {0.25, 12}});
  EXPECT_FALSE(SplitAtSwitches(m, All(m)));
}

TEST(SplitAtSwitches, LeavesARampAloneThatSamplesShow) {
  const Measurements m = Log({{0.5, 4.3}, {0.2, 5.3}, {-0.1, 6.3}, {-0.4, 7.3}, {-0.7, 12}});
  EXPECT_FALSE(SplitAtSwitches(m, All(m)));
}

TEST(SplitAtSwitches, LeavesALogAloneWhosePositionsContradictItsSpeeds) {
  Measurements m = Log({{0.5, 4.3}, {-1, 8}});
  m.position *= -1;
  EXPECT_FALSE(SplitAtSwitches(m, All(m)));
}

TEST(SplitAtSwitches, DoesNotLookAcrossAGapOrAColdStart) {
  Measurements m = Log({{0.5, 4.3}, {-1, 8.6}, {1, 12}});
  m.time.tail(7).array() += 100;  // a gap behind 4 s
  m.starts = {9};                 // behind 8 s
  EXPECT_FALSE(SplitAtSwitches(m, All(m)));
}

TEST(SplitAtSwitches, MovesStartsAndSegmentsAlong) {
  Measurements m = Log({{0.5, 4.3}, {-1, 12}});
  m.starts = {9};
  Selection selection = All(m);
  selection.segments = {{0, 5, 0.5}, {5, 12, -1}};
  const auto split = SplitAtSwitches(m, selection);
  ASSERT_TRUE(split);
  EXPECT_EQ(split->measurements.starts, std::vector<Eigen::Index>{10});
  EXPECT_EQ(split->selection.segments[0].end, 6);
  EXPECT_EQ(split->selection.segments[1].begin, 6);
  EXPECT_EQ(split->selection.segments[1].end, 13);
}

// a ramp of D = 2 x 0.3 s would not have travelled D 0.5 x 1/1.5 rad
TEST(SplitAtSwitches, TellsWhatASlowDriveWouldNotHaveTravelled) {
  const Measurements m = Log({{0.5, 4.3}, {-1, 8}});
  const auto split = SplitAtSwitches(m, All(m));
  ASSERT_TRUE(split);
  const double lost = 0.6 * 0.5 / 1.5;
  EXPECT_NEAR(split->unseen, lost / Path(m), 1e-12);
}

}  // namespace
}  // namespace warmjoint
