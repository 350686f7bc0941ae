#include "tools/suite/following_tally.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace warmjoint {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(FollowingTally, SaysNothingWhereJointsFollow) {
  FollowingTally tally;
  tally.Add({0, 0}, {1, 20, 10, 0});
  tally.Add({0, 1}, {0.81, 20, 10, 0});
  EXPECT_EQ(tally.Words({}), "");
}

TEST(FollowingTally, TellsTheWorstInWhateverOrder) {
  Suite suite;
  suite.ladder = {"", "", {{"low", {}, {}}, {"high", {}, {}}}};
  FollowingTally forwards, backwards;
  const std::vector<std::pair<Unit, Following>> units{{{0, 0}, {1, 20, 10, 0}},
                                                      {{1, 4}, {0.13, 20, 150, 0}},
                                                      {{0, 3}, {0.13, 20, 150, 0}},
                                                      {{1, 2}, {0.5, 20, 60, 0}}};
  for (const auto& [unit, following] : units) forwards.Add(unit, following);
  for (auto one = units.rbegin(); one != units.rend(); ++one) {
    backwards.Add(one->first, one->second);
  }
  EXPECT_EQ(forwards.Words(suite), backwards.Words(suite));
  EXPECT_THAT(forwards.Words(suite),
              HasSubstr("3 of 4 simulated realizations the joint did not follow its motion. In "
                        "realization 3 of low the joint reached its commanded speed in 13 %"));
}

TEST(FollowingTally, NamesTheStepWhereTheDriveNeedsAnother) {
  EXPECT_THAT((Following{0.2, 20, 150, 0}.Words()), Not(HasSubstr("timestep")));
  EXPECT_THAT((Following{0.2, 20, 300, 0.0005}.Words()),
              HasSubstr("set controller.bandwidth to 300 rad/s and timestep to 0.0005 s"));
}

}  // namespace
}  // namespace warmjoint
