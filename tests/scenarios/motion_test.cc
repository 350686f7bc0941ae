#include "scenarios/motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "scenarios/read_scenario.h"

namespace warmjoint {
namespace {

using ::testing::ElementsAre;

std::vector<MotionSegment> Plan(const Motion& motion, double duration,
                                std::uint64_t realization = 0) {
  RandomStream random({7, realization}, Stream::motion);
  return PlanMotion(motion, duration, {-1, 2}, random);
}

std::vector<double> Velocities(const std::vector<MotionSegment>& plan) {
  std::vector<double> velocities;
  for (const MotionSegment& segment : plan) velocities.push_back(segment.velocity);
  return velocities;
}

std::vector<double> Durations(const std::vector<MotionSegment>& plan) {
  std::vector<double> durations;
  for (const MotionSegment& segment : plan) durations.push_back(segment.duration);
  return durations;
}

Motion Held(std::vector<double> speeds, SegmentOrder order) {
  Motion motion;
  motion.speeds.list = std::move(speeds);
  motion.hold = 1;
  motion.order = order;
  return motion;
}

Motion Drawn(SegmentOrder order) {
  Motion motion = Held({}, order);
  motion.speeds.draws = Distribution{Distribution::Kind::uniform, 0.1, 1};
  return motion;
}

TEST(Motion, TakesTheSpeedsOfItsListInTheirOrder) {
  const struct {
    SegmentOrder order;
    std::vector<double> speeds, velocities;
  } cases[] = {{SegmentOrder::alternating, {1, 2, 3}, {1, -2, 3, -1, 2, -3}},
               // both signs for each speed of an even list
               {SegmentOrder::alternating, {1, 2}, {1, -2, 2, -1}},
               // the ladder forwards and backwards
               {SegmentOrder::in_order, {1, 2}, {1, -1, 2, -2, 1, -1}}};
  for (const auto& [order, speeds, velocities] : cases) {
    const auto duration = static_cast<double>(velocities.size());
    EXPECT_EQ(Velocities(Plan(Held(speeds, order), duration)), velocities);
  }
}

TEST(Motion, InOrderRepeatsADrawBackwards) {
  const auto velocities = Velocities(Plan(Drawn(SegmentOrder::in_order), 10));
  for (size_t i = 0; i < velocities.size(); i += 2) EXPECT_EQ(velocities[i], -velocities[i + 1]);
  EXPECT_NE(velocities[0], velocities[2]);
}

TEST(Motion, ShufflesEachRoundAnew) {
  const auto plan = Plan(Held({1, 2, 3}, SegmentOrder::shuffled), 60);
  bool differs = false;
  for (size_t round = 0; round < 10; ++round) {
    auto velocities = Velocities({plan.begin() + 6 * round, plan.begin() + 6 * round + 6});
    differs |= velocities != Velocities({plan.begin(), plan.begin() + 6});
    std::sort(velocities.begin(), velocities.end());
    EXPECT_THAT(velocities, ElementsAre(-3, -2, -1, 1, 2, 3));
  }
  EXPECT_TRUE(differs);
}

TEST(Motion, ShufflesEveryVelocityIntoEveryPlaceEquallyOften) {
  // 6000 rounds of 4 velocities: each place sees each 1500 times, sd sqrt(6000 * 3/16) = 33.5; of
  // 16 counts none is 5 sd off but for chance 1e-5
  std::map<std::pair<size_t, double>, int> counts;
  const auto plan = Plan(Held({1, 2}, SegmentOrder::shuffled), 24000);
  for (size_t i = 0; i < plan.size(); ++i) ++counts[{i % 4, plan[i].velocity}];
  EXPECT_EQ(counts.size(), 16);
  for (const auto& [key, count] : counts) EXPECT_NEAR(count, 1500, 168);
}

TEST(Motion, DrawsASpeedForEachSegmentFromItsDistribution) {
  // U(0.1, 1): mean 0.55, sd 0.9 / sqrt(12) = 0.2598; of 10000 draws the mean is within 5 sd / 100
  const auto plan = Plan(Drawn(SegmentOrder::alternating), 10000);
  double sum = 0;
  for (size_t i = 0; i < plan.size(); ++i) {
    const double velocity = plan[i].velocity;
    EXPECT_EQ(velocity > 0, i % 2 == 0);
    EXPECT_GE(std::abs(velocity), 0.1);
    EXPECT_LT(std::abs(velocity), 1.0);
    sum += std::abs(velocity);
  }
  EXPECT_NEAR(sum / 10000, 0.55, 5 * 0.2598 / 100);
}

TEST(Motion, ShuffledDrawsHaveAFairSign) {
  // 10000 signs: sd 50
  int positive = 0;
  for (double velocity : Velocities(Plan(Drawn(SegmentOrder::shuffled), 10000))) {
    positive += velocity > 0;
  }
  EXPECT_NEAR(positive, 5000, 250);
}

TEST(Motion, TravelsFromLimitToLimit) {
  Motion motion = Held({0.5, 1, 3}, SegmentOrder::alternating);
  motion.hold = 0;
  motion.travel.joint_limits = true;
  const auto plan = Plan(motion, 100);

  // the plan's position stays between the limits and ends each segment on one of them
  double position = StartPosition(motion, {-1, 2});
  EXPECT_EQ(position, -1);
  for (size_t i = 0; i + 1 < plan.size(); ++i) {
    position += plan[i].velocity * plan[i].duration;
    EXPECT_NEAR(position, i % 2 == 0 ? 2 : -1, 1e-12);
  }
}

TEST(Motion, ShuffledTravelStillTurnsAtEachLimit) {
  Motion motion = Held({0.5, 1, 3}, SegmentOrder::shuffled);
  motion.hold = 0;
  motion.travel.limits = {0.0, 1.0};
  const auto velocities = Velocities(Plan(motion, 100));
  for (size_t i = 0; i < velocities.size(); ++i) EXPECT_EQ(velocities[i] > 0, i % 2 == 0);
}

TEST(Motion, GoesOnAfterARestWhereItStopped) {
  Motion motion = Held({2}, SegmentOrder::alternating);
  motion.hold = 4;
  motion.rests = Rests{6, 5};
  const auto plan = Plan(motion, 21);
  EXPECT_THAT(Velocities(plan), ElementsAre(2, -2, 0, -2, 2, 0));
  EXPECT_THAT(Durations(plan), ElementsAre(4, 2, 5, 2, 4, 4));
}

TEST(Motion, RepeatsItsPhasesUntilTheEnd) {
  Motion motion;
  motion.phases = {{3, Held({2}, SegmentOrder::alternating)}, {5, std::nullopt}};
  const auto plan = Plan(motion, 10);
  EXPECT_THAT(Velocities(plan), ElementsAre(2, -2, 2, 0, 2, -2));
  EXPECT_THAT(Durations(plan), ElementsAre(1, 1, 1, 5, 1, 1));
}

TEST(Motion, RepeatsItsBitsForTheSameRealizationOnly) {
  const Motion motion = Drawn(SegmentOrder::alternating);
  EXPECT_EQ(Velocities(Plan(motion, 50, 3)), Velocities(Plan(motion, 50, 3)));
  EXPECT_NE(Velocities(Plan(motion, 50, 3)), Velocities(Plan(motion, 50, 4)));
}

std::vector<VelocityCorner> Corners(const Motion& motion, double duration,
                                    std::uint64_t realization = 0) {
  RandomStream random({7, realization}, Stream::motion);
  return PlanCorners(motion, duration, random);
}

const std::string kRest =
    "duration: 10\nfriction: {law: coulomb, parameters: {coulomb: 1}}\nmotion:\n  ";

Motion Read(const std::string& yaml) { return ParseScenario(kRest + yaml, "motion").motion; }

TEST(PlanCorners, FourierBeginsAtRestAndReachesItsSpeed) {
  const Motion motion = Read("fourier: {period: 10, harmonics: 5, speed: 1.5}");
  ASSERT_TRUE(FollowsCorners(motion));
  const auto corners = Corners(motion, 25);
  EXPECT_EQ(corners.front().velocity, 0);
  EXPECT_GE(corners.back().time, 25);
  double most = 0;
  for (const VelocityCorner& one : corners) most = std::max(most, std::abs(one.velocity));
  EXPECT_NEAR(most, 1.5, 1e-12);

  // it repeats itself after its period: 2500 corners
  for (size_t i = 0; i < 2500; ++i) EXPECT_EQ(corners[i].velocity, corners[i + 2500].velocity);
  EXPECT_NE(Corners(motion, 25, 1)[100].velocity, corners[100].velocity) << "drawn anew";
}

TEST(PlanCorners, MovesStayBetweenTheirLimitsAndPause) {
  const Motion motion = Read("moves: {between: [-1, 2], speed: 1, acceleration: 4, pause: 0.5}");
  const auto corners = Corners(motion, 60);
  double position = StartPosition(motion, {-9, 9});
  EXPECT_EQ(position, 0.5);
  int pauses = 0;
  for (size_t i = 1; i < corners.size(); ++i) {
    const VelocityCorner &from = corners[i - 1], &to = corners[i];
    position += (to.time - from.time) * (from.velocity + to.velocity) / 2;
    EXPECT_GT(position, -1 - 1e-9);
    EXPECT_LT(position, 2 + 1e-9);
    EXPECT_LE(std::abs(to.velocity), 1);
    EXPECT_LE(std::abs(to.velocity - from.velocity), 4 * (to.time - from.time) + 1e-9);
    pauses += from.velocity == 0 && to.velocity == 0;
  }
  EXPECT_GT(pauses, 20);
}

}  // namespace
}  // namespace warmjoint
