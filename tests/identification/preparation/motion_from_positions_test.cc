#include "identification/preparation/motion_from_positions.h"

#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>

#include <cmath>
#include <numbers>

#include "tests/identification/preparation/driven_joint.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using test::Carried;
using test::Drive;
using test::Driven;

double PathOf(const Measurements& m) {
  const Index n = m.size() - 1;
  return m.velocity.head(n).cwiseAbs().dot(m.time.tail(n) - m.time.head(n));
}

/// Of the whole path, how much too long the prepared log has it.
double Excess(const Drive& drive) {
  const Driven driven = Carried(drive);
  const double path = driven.path[driven.path.size() - 1];
  return PathOf(Prepare(driven.log).constant_speed().measurements) / path - 1;
}

TEST(MotionFromPositions, HasThePathOfTheJoint) {
  // what the gain would move by; half steps of a smoothed velocity made 0.2 to 4 %
  EXPECT_LT(std::abs(Excess({.rate = 1, .hold = 20, .acceleration = 0})), 5e-4);
  EXPECT_LT(std::abs(Excess({.rate = 5, .hold = 10})), 5e-4);
  EXPECT_LT(std::abs(Excess({.rate = 20})), 5e-4);
  EXPECT_LT(std::abs(Excess({.rate = 20, .resolution = 2 * std::numbers::pi / 4096})), 5e-4);
  EXPECT_LT(std::abs(Excess({.rate = 100, .resolution = 2 * std::numbers::pi / 1000})), 1e-3);
}

TEST(MotionFromPositions, HasThePathOfAJointThatPausesOrRipples) {
  EXPECT_LT(std::abs(Excess({.rate = 50, .hold = 2, .acceleration = 5, .pause = 0.3})), 5e-4);
  EXPECT_LT(std::abs(Excess({.rate = 100, .acceleration = 5, .ripple = 0.02})), 5e-4);
}

TEST(MotionFromPositions, HoldsOneSpeedForEachSegment) {
  const Driven driven = Carried({});
  const LogView steady = Prepare(driven.log).constant_speed();
  ASSERT_EQ(steady.selection.segments.size(), 30U);
  for (const Segment& segment : steady.selection.segments) {
    for (Index i = segment.begin; i + 1 < segment.end; ++i) {
      // the last step of a segment is told by the difference of two positions
      EXPECT_NEAR(steady.measurements.velocity[i], segment.velocity, 1e-9);
    }
  }
}

TEST(MotionFromPositions, KeepsNoSampleOfARampAndNearlyAllOthers) {
  for (const double resolution : {0.0, 2 * std::numbers::pi / 4096}) {
    const Driven driven = Carried({.resolution = resolution});
    const LogView steady = Prepare(driven.log).constant_speed();
    Index taken = 0, constant = 0, kept = 0;
    for (Index i = 0; i < steady.measurements.size(); ++i) {
      while (taken + 1 < driven.log.size() &&
             driven.log.time[taken] < steady.measurements.time[i]) {
        ++taken;
      }
      if (!steady.selection.keep[i]) continue;
      ++kept;
      EXPECT_NEAR(steady.measurements.velocity[i], driven.velocity[taken], 0.01);
    }
    for (Index i = 1; i < driven.log.size(); ++i) {
      constant += driven.velocity[i] == driven.velocity[i - 1];
    }
    EXPECT_GT(kept, 0.93 * static_cast<double>(constant));
  }
}

TEST(MotionFromPositions, DoesNotDependOnWhereTheEncoderHasItsZero) {
  Drive drive{.resolution = 2 * std::numbers::pi / 4096};
  const LogView here = Prepare(Carried(drive).log).constant_speed();
  drive.origin = 200 * std::numbers::pi;
  const LogView there = Prepare(Carried(drive).log).constant_speed();
  EXPECT_TRUE((here.selection.keep == there.selection.keep).all());
  // the rounding of 628 rad over that of the way of a segment
  const Eigen::ArrayXd apart = here.measurements.velocity - there.measurements.velocity;
  EXPECT_LT(here.selection.keep.select(apart.abs(), 0.0).maxCoeff(), 1e-9);
}

TEST(MotionFromPositions, TakesJoinedRecordingsOneByOne) {
  const Measurements one = Carried({.seed = 1}).log, other = Carried({.rate = 100, .seed = 2}).log;
  const LogView alone = Prepare(other).constant_speed();
  const LogView joined = Prepare(std::vector{one, other}).constant_speed();
  const Index n = alone.measurements.size();
  ASSERT_EQ(joined.measurements.further_starts.size(), 1U);
  ASSERT_EQ(joined.measurements.size() - joined.measurements.further_starts[0], n);
  EXPECT_TRUE((joined.selection.keep.tail(n) == alone.selection.keep).all());
  EXPECT_LT(
      (joined.measurements.velocity.tail(n) - alone.measurements.velocity).cwiseAbs().maxCoeff(),
      1e-9);
}

TEST(MotionFromPositions, DoesNotLookAcrossAGap) {
  Measurements log = Carried({}).log;
  const Index n = log.size() / 2;
  log.time.tail(n).array() += 100;
  const LogView steady = Prepare(log).constant_speed();
  for (const Segment& segment : steady.selection.segments) {
    for (Index i = segment.begin + 1; i < segment.end; ++i) {
      EXPECT_LT(steady.measurements.time[i] - steady.measurements.time[i - 1], 1);
    }
  }
}

}  // namespace
}  // namespace warmjoint
