#include "models/recording/join_recordings.h"

#include <gmock/gmock.h>

#include "models/foundation/bad_input.h"

namespace warmjoint {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// n samples 0.5 s apart from `begin` on, all of one value.
Measurements Recording(const std::string& source, Eigen::Index n, double begin, double value) {
  Measurements m;
  m.source = source;
  m.time = begin + 0.5 * Eigen::ArrayXd::LinSpaced(n, 0, static_cast<double>(n - 1));
  m.position = m.velocity = m.torque = Eigen::VectorXd::Constant(n, value);
  return m;
}

TEST(JoinRecordings, PutsOneAfterTheOtherAStepApart) {
  const Measurements joined = JoinRecordings(
      {Recording("a", 3, 0, 1), Recording("b", 2, 100, 2), Recording("c", 2, -5, 3)});
  EXPECT_THAT(joined.starts, ElementsAre(3, 5));
  EXPECT_THAT(joined.time, ElementsAre(0, 0.5, 1, 1.5, 2, 2.5, 3));
  EXPECT_THAT(joined.torque, ElementsAre(1, 1, 1, 2, 2, 3, 3));
  EXPECT_THAT(joined.position, ElementsAre(1, 1, 1, 2, 2, 3, 3));
  EXPECT_EQ(joined.source, "a + b + c");
}

TEST(JoinRecordings, LeavesOneRecordingAsItIs) {
  const Measurements one = JoinRecordings({Recording("a", 3, 7, 1)});
  EXPECT_TRUE(one.starts.empty());
  EXPECT_EQ(one.time[0], 7);
  EXPECT_EQ(one.source, "a");
}

TEST(JoinRecordings, LeavesOutAColumnThatOneLacks) {
  Measurements with = Recording("with", 3, 0, 1);
  with.load = Eigen::VectorXd::Ones(3);
  with.temperature = Eigen::VectorXd::Constant(3, 25);
  Measurements without = Recording("without", 2, 0, 1);
  without.temperature = Eigen::VectorXd::Constant(2, 26);
  const Measurements joined = JoinRecordings({with, without});
  EXPECT_FALSE(joined.load);
  EXPECT_THAT(joined.notes, ElementsAre(HasSubstr("load is left out")));
  EXPECT_THAT(*joined.temperature, ElementsAre(25, 25, 25, 26, 26));
}

TEST(JoinRecordings, RefusesAnotherUnitAndNothing) {
  Measurements amperes = Recording("b", 3, 0, 1);
  amperes.torque_unit = "A";
  EXPECT_THAT(
      [&] {
        JoinRecordings({Recording("a", 3, 0, 1), amperes});
      },
      ThrowsMessage<BadInput>(HasSubstr("b: is of another joint or in another unit (A)")));
  EXPECT_THROW(JoinRecordings({}), BadInput);
}

}  // namespace
}  // namespace warmjoint
