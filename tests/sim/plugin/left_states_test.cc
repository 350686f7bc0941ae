// States of joints as a step has left them.
#include "sim/plugin/joint_states.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "tests/sim/plugin/two_forms.h"

namespace warmjoint {
namespace {

using namespace test;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Joints whose states begin there: two each, but three of a joint with two stages of heat.
std::vector<BoundJoint> JointsAt(const std::vector<int>& begins, const std::vector<int>& states) {
  std::vector<BoundJoint> joints;
  for (size_t i = 0; i < begins.size(); ++i) {
    FrictionDescription friction = FrictionsOfEveryLaw()[0];
    if (states[i] == 3) friction.second_thermal = Thermal{-0.01, 0.5};
    BoundJoint joint{.friction = JointFriction(friction)};
    joint.state = begins[i];
    joints.push_back(std::move(joint));
  }
  return joints;
}

TEST(LeftStates, AreAsFewStretchesAsThereAre) {
  EXPECT_EQ(LeftStates(JointsAt({4, 6, 8}, {2, 2, 2})).runs().size(), 1);
  const std::vector<StateRun> runs = LeftStates(JointsAt({1, 4, 9}, {3, 2, 2})).runs();
  ASSERT_EQ(runs.size(), 2);
  EXPECT_EQ(runs[0].begin, 1);
  EXPECT_EQ(runs[0].states, 5);
  EXPECT_EQ(runs[1].begin, 9);
  EXPECT_EQ(runs[1].next, 5);
  EXPECT_EQ(runs[1].states, 2);
}

TEST(LeftStates, MatchThemselvesAtTheirTimeAndNothingElse) {
  LeftStates left(JointsAt({0, 5}, {3, 2}));
  std::vector<mjtNum> act{0.1, 0.2, 0.3, 7, 8, -0.4, 0.5};
  EXPECT_FALSE(left.Match(act.data(), 0)) << "before the first step";
  left.Keep(act.data(), 2);
  EXPECT_TRUE(left.Match(act.data(), 2));
  EXPECT_FALSE(left.Match(act.data(), 2.001));
  for (size_t k = 0; k < act.size(); ++k) {
    const double before = act[k];
    act[k] = std::nextafter(before, 10);
    // what is between the joints' states is not theirs
    EXPECT_EQ(left.Match(act.data(), 2), k == 3 || k == 4) << k;
    act[k] = before;
  }
}

TEST(LeftStates, ArePutWhereTheJointsHaveThem) {
  LeftStates left(JointsAt({0, 5}, {3, 2}));
  std::vector<mjtNum> act(7, -1.0);
  left.Put({1, 2, 3, 4, 5}, act.data(), 3);
  EXPECT_EQ(act, (std::vector<mjtNum>{1, 2, 3, -1, -1, 4, 5}));
  EXPECT_TRUE(left.Match(act.data(), 3));
}

TEST(LeftStates, AreThoseOnWhichTheEnginesStepLands) {
  LeftStates left(JointsAt({0, 5}, {3, 2}));
  const std::vector<double> next{0.1, 0.02, 0.3, 0.7, 0.55};
  std::vector<mjtNum> act(7, -1.0), rates(7, 0.0);
  const double h = 0.003;
  EXPECT_TRUE(left.FindRates(next, act.data(), h, rates.data()));
  EXPECT_EQ(rates[3], 0);
  for (size_t k = 0; k < act.size(); ++k) act[k] += rates[k] * h;
  EXPECT_NEAR(act[1], 0.02, 1e-15);
  EXPECT_FALSE(left.Match(act.data(), 1));
  left.Ended(1);
  EXPECT_TRUE(left.Match(act.data(), 1));
}

TEST(LeftStates, TellNumbersThatAreNone) {
  LeftStates left(JointsAt({0, 5}, {3, 2}));
  const std::vector<double> next(5, 0.0);
  std::vector<mjtNum> act(7, 1.0), rates(7, 0.0);
  for (const double none : {kNan, -kNan, std::numeric_limits<double>::infinity()}) {
    for (size_t k = 0; k < act.size(); ++k) {
      act[k] = none;
      const bool finite = left.FindRates(next, act.data(), 0.001, rates.data());
      EXPECT_EQ(finite, k == 3 || k == 4) << k;
      act[k] = 1;
    }
  }
}

}  // namespace
}  // namespace warmjoint
