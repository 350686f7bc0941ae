#include <gmock/gmock.h>
#include <warmjoint/errors.h>
#include <warmjoint/prepared_log.h>

#include "tests/identification/preparation/driven_joint.h"
#include "tests/support/warm_recording.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// Speeds held for 20 s, sampled every h from `begin` on, s. n: samples
Measurements Recording(const std::string& source, Index n, double h, double begin,
                       std::uint64_t seed) {
  Measurements m =
      test::RecordFriction(test::TableOne(), h, test::AlternatingSpeeds(n, seed), 0.1, seed);
  m.source = source;
  m.time.array() += begin;
  return m;
}

/// The samples of a recording in a view of several, from its first on.
void ExpectPart(const LogView& all, Index first, const LogView& one) {
  const Index n = one.measurements.size();
  ASSERT_LE(first + n, all.measurements.size());
  EXPECT_EQ(all.measurements.velocity.segment(first, n), one.measurements.velocity);
  EXPECT_EQ(all.measurements.position.segment(first, n), one.measurements.position);
  EXPECT_EQ(all.measurements.torque.segment(first, n), one.measurements.torque);
  EXPECT_TRUE((all.selection.keep.segment(first, n) == one.selection.keep).all());
  const Eigen::ArrayXd shift =
      all.measurements.time.segment(first, n).array() - one.measurements.time.array();
  EXPECT_LT(shift.maxCoeff() - shift.minCoeff(), 1e-9);
}

TEST(Join, EachRecordingIsPreparedByItself) {
  const Measurements slow = Recording("a", 900, 1, 0, 1), late = Recording("b", 600, 0.5, 1e4, 2);
  Measurements without = Recording("c", 800, 1, -50, 3);
  without.velocity.resize(0);
  const PreparedLog joined = Prepare(std::vector{slow, late, without});
  const PreparedLog parts[] = {Prepare(slow), Prepare(late), Prepare(without)};
  EXPECT_THAT(joined.raw().measurements.further_starts, ElementsAre(900, 1500));
  EXPECT_EQ(joined.raw().measurements.source, "a + b + c");
  Index taken = 0, steady = 0, moving = 0;
  for (const PreparedLog& part : parts) {
    ExpectPart(joined.raw(), taken, part.raw());
    ExpectPart(joined.constant_speed(), steady, part.constant_speed());
    ExpectPart(joined.moving(), moving, part.moving());
    taken += part.raw().measurements.size();
    steady += part.constant_speed().measurements.size();
    moving += part.moving().measurements.size();
  }
  EXPECT_EQ(joined.constant_speed().measurements.size(), steady);
  // the next begins a step behind the last sample
  const Eigen::VectorXd& time = joined.raw().measurements.time;
  EXPECT_DOUBLE_EQ(time[900] - time[899], 1);
  EXPECT_DOUBLE_EQ(time[1500] - time[1499], 0.5);
  for (const Segment& one : joined.raw().selection.segments) {
    EXPECT_EQ(one.begin < 900, one.end <= 900);
    EXPECT_EQ(one.begin < 1500, one.end <= 1500);
  }
}

TEST(Join, LeavesOneRecordingAsItIs) {
  const Measurements m = Recording("a", 300, 1, 7, 1);
  const LogSamples one = Prepare(std::vector{m}).raw().measurements;
  EXPECT_TRUE(one.further_starts.empty());
  EXPECT_EQ(one.time, m.time);
  EXPECT_EQ(one.source, "a");
}

TEST(Join, LeavesOutAColumnThatOneLacks) {
  Measurements with = Recording("with", 300, 1, 0, 1), without = Recording("without", 200, 1, 0, 2);
  with.load = Eigen::VectorXd::Ones(300);
  with.temperature = Eigen::VectorXd::Constant(300, 25);
  without.temperature = Eigen::VectorXd::Constant(200, 26);
  const Measurements joined = Prepare(std::vector{with, without}).raw().measurements;
  EXPECT_FALSE(joined.load);
  EXPECT_THAT(joined.notes, ElementsAre(HasSubstr("load is left out")));
  EXPECT_EQ(joined.temperature->head(300), *with.temperature);
  EXPECT_EQ(joined.temperature->tail(200), *without.temperature);
}

TEST(Join, RefusesAnotherUnitAndNothing) {
  const Measurements m = Recording("a", 300, 1, 0, 1);
  Measurements amperes = Recording("b", 300, 1, 0, 1);
  amperes.torque_unit = "A";
  EXPECT_THAT(
      [&] {
        Prepare(std::vector{m, amperes});
      },
      ThrowsMessage<BadInput>(HasSubstr("b: is of another joint or in another unit (A)")));
  EXPECT_THROW(Prepare(std::vector<Measurements>{}), BadInput);
}

TEST(Join, LeavesOutWhatIsAbsurdInEach) {
  Measurements one = Recording("a", 900, 1, 0, 1), other = Recording("b", 600, 1, 0, 2);
  other.torque[333] = -1e5;
  const PreparedLog joined = Prepare(std::vector{one, other});
  EXPECT_THAT(joined.faults(), ElementsAre(HasSubstr("b: torque is far out of range")));
  const PreparedLog& without = joined.WithoutAbsurd();
  EXPECT_TRUE(without.faults().empty());
  EXPECT_FALSE(without.raw().selection.keep[900 + 333]);
  EXPECT_FALSE(without.moving().selection.keep[900 + 333]);
  EXPECT_EQ(&without.WithoutAbsurd(), &without);
}

TEST(PreparedLog, KnowsWhichSamplesWereLogged) {
  // speeds change between two samples, where some are put in
  const Measurements m = test::Carried({.rate = 10, .acceleration = 5}).log;
  for (const PreparedLog& log : {Prepare(m), Prepare(std::vector{m, m})}) {
    const LogSamples& all = log.constant_speed().measurements;
    ASSERT_FALSE(all.inserted.empty());
    EXPECT_EQ(Eigen::VectorXd(all.time(all.Logged())), log.raw().measurements.time);
  }
}

TEST(PreparedLog, BeforeCutsTheRecordingsAtATime) {
  const Measurements one = Recording("a", 900, 1, 0, 1), other = Recording("b", 600, 1, 1e4, 2);
  const PreparedLog joined = Prepare(std::vector{one, other});
  const Eigen::VectorXd& time = joined.raw().measurements.time;
  for (const Index n : {3, 700, 900, 903, 1300, 1500}) {
    const PreparedLog before = joined.Before(n < 1500 ? time[n] : time[1499] + 1);
    ASSERT_EQ(before.raw().measurements.size(), n);
    EXPECT_EQ(before.raw().measurements.time, time.head(n));
    EXPECT_EQ(before.raw().measurements.further_starts.size(), n > 900 ? 1 : 0);
    EXPECT_EQ(before.moving().measurements.size(), before.moving().selection.keep.size());
  }
  // a sample or two of the next recording show no motion
  EXPECT_EQ(joined.Before(time[901]).raw().measurements.size(), 900);
}

}  // namespace
}  // namespace warmjoint
