// The path of a joint by its positions and by its velocity.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "identification/preparation/motion_from_positions.h"
#include "identification/preparation/transitions.h"
#include "models/foundation/random_stream.h"
#include "tests/identification/preparation/driven_joint.h"
#include "tests/support/judging.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kStep = 0.1;        // s
constexpr double kCount = 9.587e-5;  // rad
constexpr int kHolds = 60;           // of 5 s

/// A log at 10 Hz with a velocity, with positions in 65,536 counts a turn.
test::Driven Ramps() {
  test::Driven driven =
      test::Carried({.rate = 1 / kStep, .acceleration = 5, .resolution = kCount, .speeds = kHolds});
  driven.log.velocity = driven.velocity;
  driven.log.torque = 5 * driven.velocity + 15 * driven.velocity.cwiseSign();
  return driven;
}

/// The path between two times at which there are samples, with every velocity held until the next sample.
double HeldPath(const Measurements& m, double from, double to) {
  double path = 0;
  for (Index i = 0; m.time[i] < to; ++i) {
    if (m.time[i] >= from) path += std::abs(m.velocity[i]) * (m.time[i + 1] - m.time[i]);
  }
  return path;
}

TEST(ReplaceTransitions, LossesOfRampsAreThoseOfThePositions) {
  const auto [log, path, velocity] = Ramps();
  const PreparedLog prepared = Prepare(log);
  EXPECT_TRUE(prepared.warnings().empty());

  // from the middle of the first segment to that of the last
  const auto& segments = prepared.raw().selection.segments;
  const auto middle = [](const Segment& segment) { return (segment.begin + segment.end) / 2; };
  const Index first = middle(segments.front()), last = middle(segments.back());
  const auto excess = [&](const Measurements& m) {
    return HeldPath(m, log.time[first], log.time[last]) / (path[last] - path[first]) - 1;
  };

  // speeds that are held until the next sample lack what ramps and reversals lose between two
  EXPECT_GT(std::abs(excess(log)), 1e-3);

  // a turn that is off by a count, each way: 60 sqrt(2) counts / sqrt(12) by chance, 5 deviations
  const double most = 5 * std::sqrt(2.0 * kHolds / 12) * kCount / (path[last] - path[first]);
  EXPECT_LT(std::abs(excess(prepared.constant_speed().measurements)), most);
}

TEST(ReplaceTransitions, SegmentsKeepTheVelocityColumn) {
  const Measurements log = Ramps().log;
  const PreparedLog prepared = Prepare(log);
  const auto& [m, selection] = prepared.constant_speed();
  EXPECT_EQ(selection.count(), prepared.raw().selection.count());
  Index n = 0;
  for (Index i = 0; i < m.size(); ++i) {
    if (m.time[i] != log.time[n]) {
      EXPECT_FALSE(selection.keep[i]);
      continue;
    }
    EXPECT_EQ(selection.keep[i], prepared.raw().selection.keep[n]);
    if (selection.keep[i]) {
      EXPECT_EQ(m.velocity[i], log.velocity[n]);
    }
    ++n;
  }
  EXPECT_EQ(n, log.size());
  const auto& segments = prepared.raw().selection.segments;
  ASSERT_EQ(selection.segments.size(), segments.size());
  for (size_t i = 0; i < segments.size(); ++i) {
    EXPECT_EQ(m.time[selection.segments[i].begin], log.time[segments[i].begin]);
    // nothing is put in within a segment
    const Index length = segments[i].end - segments[i].begin;
    EXPECT_EQ(m.time[selection.segments[i].begin + length - 1], log.time[segments[i].end - 1]);
  }
}

/// Table I at 20 Hz, speeds of U(0.1, 1) rad/s for 5 s each, with ramps of 5 rad/s^2.
Measurements Ramped() {
  const VectorXd speeds = test::AlternatingSpeeds(60 * 20, 3);
  VectorXd velocity(60 * 100);
  double v = 0;
  for (Index i = 0; i < velocity.size(); ++i) {
    v += std::clamp(speeds[i / 100 * 20] - v, -0.25, 0.25);
    velocity[i] = v;
  }
  Measurements log = test::RecordFriction(test::TableOne(), 0.05, velocity, 0.1, 1);

  // trapezoids, as a joint moves whose velocity is linear between two samples
  log.position[0] = 0;
  for (Index i = 1; i < log.size(); ++i) {
    log.position[i] = log.position[i - 1] + 0.025 * (velocity[i - 1] + velocity[i]);
  }
  return log;
}

/// First-order low-pass of the velocity column, s.
Measurements Filtered(Measurements log, double time_constant) {
  double filtered = log.velocity[0];
  for (double& v : log.velocity) {
    filtered += -std::expm1(-0.05 / time_constant) * (v - filtered);
    v = filtered;
  }
  return log;
}

TEST(PathAgainstVelocity, BelievesTheColumnWhereTheClockJitters) {
  // 0.6 s of jitter at 1 Hz: by their stamps alone some positions tell speeds that are 13 % too low
  int contradicted = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Measurements log = test::RecordHour(test::TableOne(), seed);
    double turn = 0;
    for (double& t : log.time) {
      t += 0.6 * (turn - 0.5);
      turn = std::fmod(turn + std::numbers::phi - 1, 1.0);
    }
    const PreparedLog prepared = Prepare(log);
    EXPECT_EQ(prepared.raw().measurements.velocity, log.velocity) << seed;
    contradicted += !prepared.warnings().empty();
  }
  EXPECT_GT(contradicted, 0);
}

TEST(PathAgainstVelocity, ReplacesAVelocityThatIsFiltered) {
  const PreparedLog prepared = Prepare(Filtered(Ramped(), 0.2));
  EXPECT_THAT(prepared.warnings(), ElementsAre(HasSubstr("shorter than that of the positions")));
  EXPECT_THAT(prepared.faults(), IsEmpty());

  // what is kept moves as the joint does
  const Measurements truth = Ramped();
  const LogView& steady = prepared.constant_speed();
  Index taken = 0;
  for (Index i = 0; i < steady.measurements.size(); ++i) {
    while (truth.time[taken] < steady.measurements.time[i]) ++taken;
    if (!steady.selection.keep[i]) continue;
    EXPECT_NEAR(steady.measurements.velocity[i], truth.velocity[taken], 1e-6);
  }
}

TEST(PathAgainstVelocity, ReplacesAVelocityThatIsScaledByOnePercent) {
  Measurements log = Ramped();
  log.velocity *= 1.01;
  EXPECT_THAT(Prepare(log).warnings(),
              ElementsAre(HasSubstr("1 % longer than that of the positions")));
}

TEST(PathAgainstVelocity, BelievesTheVelocityWhereThePositionIsStuckForAWhile) {
  Measurements log = Ramped();
  log.position.segment(1000, 600).setConstant(log.position[1000]);
  const PreparedLog prepared = Prepare(log);
  EXPECT_EQ(prepared.raw().measurements.velocity, log.velocity);
}

TEST(PrepareSettings, LeaveOutEndsAndShortHolds) {
  const Measurements log = Ramped();
  const Selection all = Prepare(log).raw().selection;
  const Selection trimmed = Prepare(log, {.trim = 0.5}).raw().selection;
  ASSERT_EQ(trimmed.segments.size(), all.segments.size());
  for (size_t i = 0; i < all.segments.size(); ++i) {
    EXPECT_EQ(trimmed.segments[i].begin, all.segments[i].begin + 10);
    EXPECT_EQ(trimmed.segments[i].end, all.segments[i].end - 10);
  }
  EXPECT_EQ(trimmed.count(), all.count() - 20 * static_cast<Index>(all.segments.size()));
  EXPECT_EQ(Prepare(log, {.shortest_hold = 100}).raw().selection.count(), 0);
}

/// Samples a second apart.
VectorXd Monotone(const VectorXd& position, double hysteresis) {
  const auto n = static_cast<double>(position.size());
  return MonotonePath(VectorXd::LinSpaced(position.size(), 0, n - 1), position, hysteresis);
}

double PathOf(const VectorXd& p) {
  return (p.tail(p.size() - 1) - p.head(p.size() - 1)).cwiseAbs().sum();
}

TEST(MonotonePath, LeadsThroughTheMiddleOfWhatLeadsBackWithinTheHysteresis) {
  VectorXd way(5), pooled(5);
  way << 0, 2, 1, 3, 4;
  pooled << 0, 1, 2, 3, 4;
  EXPECT_EQ(Monotone(way, 1.5), pooled);
  EXPECT_EQ(Monotone(way, 0.5), way) << "it turned round";
}

TEST(MonotonePath, TakesTheNoiseOutOfThePath) {
  // there and back, 10 rad each, with noise as large as a step
  const Eigen::Index n = 2000;
  RandomStream random({1, 1}, Stream::test);
  VectorXd noisy(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    noisy[i] = 10 - std::abs(10 - 20.0 * static_cast<double>(i) / (n - 1)) + 0.01 * random.Normal();
  }
  EXPECT_GT(PathOf(noisy), 25);
  // what is left lies at the two ends and at the turn: two deviations each at most, mostly
  EXPECT_NEAR(PathOf(Monotone(noisy, 0.27)), 20, 0.1);
}

TEST(MonotonePath, KeepsARestWithDitherStill) {
  VectorXd rest(6);
  rest << 0, 1, 0, 1, 0, 1;
  EXPECT_LE(PathOf(Monotone(rest, 3)), 1);
}

TEST(ReplaceTransitions, AWayThatSamplesCannotHideStaysAsItIs) {
  Measurements log = Ramps().log;
  const PreparedLog prepared = Prepare(log);
  const LogView& taken = prepared.raw();
  const auto& segments = taken.selection.segments;
  const auto middle = [&](size_t i) { return (segments[i].begin + segments[i].end) / 2; };
  LogSamples by_velocity(log), other(log);
  other.velocity *= 0.5;

  // one step at the change of speed is the most that a sample hides
  const Transition way{middle(3), middle(4), 4, 0};
  const double most = kStep * std::abs(log.velocity[way.last] - log.velocity[way.first]);
  for (const bool is_hidden : {true, false}) {
    Transition one = way;
    one.difference = (is_hidden ? 0.9 : 1.1) * most;
    const Measurements made = ReplaceTransitions(taken, by_velocity, other, {one}).measurements;
    Index j = way.first;
    for (Index i = way.first; i < way.last; ++i, ++j) {
      // one is put in right behind the last of the segment
      const bool changes = is_hidden && !taken.selection.keep[i];
      if (changes && taken.selection.keep[i - 1]) {
        EXPECT_EQ(made.velocity[j], other.velocity[i - 1]);
        ++j;
      }
      ASSERT_EQ(made.time[j], log.time[i]);
      EXPECT_EQ(made.velocity[j], changes ? other.velocity[i] : log.velocity[i]) << i;
    }
    EXPECT_EQ(j - way.last, is_hidden ? 1 : 0);
    EXPECT_EQ(made.velocity.head(way.first), log.velocity.head(way.first));
  }
}

}  // namespace
}  // namespace warmjoint
