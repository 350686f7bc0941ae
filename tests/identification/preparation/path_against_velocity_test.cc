#include "identification/preparation/path_against_velocity.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "identification/preparation/prepare.h"
#include "tests/support/judging.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

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

TEST(PathAgainstVelocity, LeavesAVelocityThatThePositionsConfirm) {
  const Measurements log = Ramped();
  const PreparedLog prepared = Prepare(log);
  EXPECT_THAT(prepared.warnings(), IsEmpty());
  EXPECT_EQ(prepared.taken().measurements.velocity, log.velocity);
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
    EXPECT_EQ(prepared.taken().measurements.velocity, log.velocity) << seed;
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
  const LogView& steady = prepared.steady();
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
  EXPECT_EQ(prepared.taken().measurements.velocity, log.velocity);
}

TEST(PrepareSettings, LeaveOutEndsAndShortHolds) {
  const Measurements log = Ramped();
  const Selection all = Prepare(log).taken().selection;
  const Selection trimmed = Prepare(log, {.trim = 0.5}).taken().selection;
  ASSERT_EQ(trimmed.segments.size(), all.segments.size());
  for (size_t i = 0; i < all.segments.size(); ++i) {
    EXPECT_EQ(trimmed.segments[i].begin, all.segments[i].begin + 10);
    EXPECT_EQ(trimmed.segments[i].end, all.segments[i].end - 10);
  }
  EXPECT_EQ(trimmed.count(), all.count() - 20 * static_cast<Index>(all.segments.size()));
  EXPECT_EQ(Prepare(log, {.shortest_hold = 100}).taken().selection.count(), 0);
}

}  // namespace
}  // namespace warmjoint
