// How far a motion takes a joint, by hand.
#include "sim/plant/single_joint_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "models/foundation/bad_input.h"

namespace warmjoint {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// A motion that reaches `farthest`, rad: any room up to there is too small, and any beyond it does.
template <typename Motion>
void ExpectFarthest(const Motion& motion, double duration, double start, double farthest) {
  Scenario scenario;
  scenario.name = "reach";
  scenario.joint = "hinge";
  scenario.duration = duration;
  const auto check = [&](double limit) { CheckReach({scenario, {-10, limit}}, motion, start); };
  EXPECT_NO_THROW(check(farthest));
  EXPECT_NO_THROW(check(farthest + 1e-3));
  EXPECT_THAT([&] { check(farthest - 1e-3); },
              ThrowsMessage<BadInput>(AllOf(HasSubstr("reach"), HasSubstr("'hinge'"))));
}

using Pieces = std::vector<MotionSegment>;
using Corners = std::vector<VelocityCorner>;

TEST(MotionReach, PiecesAddUp) {
  ExpectFarthest(Pieces{{2, 0.5}, {1, -1}, {1, 0.25}}, 4, 0.5, 1.5);
  ExpectFarthest(Pieces{{1, -0.5}, {3, 0.5}}, 4, 0, 1);
}

TEST(MotionReach, ARampThatReversesIsFarthestWhereItTurns) {
  // from 1 rad/s to -3 rad/s in 4 s: it turns after 1 s, half a radian ahead
  ExpectFarthest(Corners{{0, 1}, {4, -3}, {5, -3}}, 5, 0, 0.5);
  // and one that only slows down, at its end
  ExpectFarthest(Corners{{0, 1}, {2, 0}, {4, 0}}, 4, 0.25, 1.25);
}

TEST(MotionReach, OnlyTheWayUntilTheEndCounts) {
  // a hold that would go on
  ExpectFarthest(Corners{{0, 0.5}, {10, 0.5}}, 3, 0, 1.5);
  // a ramp that would go on: 0.25 t^2 of it
  ExpectFarthest(Corners{{0, 0}, {4, 2}}, 2, 0, 1);
  // a speed that stays behind the last corner
  ExpectFarthest(Corners{{0, 0}, {2, 1}}, 5, 0, 4);
}

}  // namespace
}  // namespace warmjoint
