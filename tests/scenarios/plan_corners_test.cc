#include <gtest/gtest.h>

#include <cmath>

#include "scenarios/motion.h"
#include "scenarios/read_scenario.h"

namespace warmjoint {
namespace {

std::vector<VelocityCorner> Plan(const Motion& motion, double duration,
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
  const auto corners = Plan(motion, 25);
  EXPECT_EQ(corners.front().velocity, 0);
  EXPECT_GE(corners.back().time, 25);
  double most = 0;
  for (const VelocityCorner& one : corners) most = std::max(most, std::abs(one.velocity));
  EXPECT_NEAR(most, 1.5, 1e-12);

  // it repeats itself after its period: 2500 corners
  for (size_t i = 0; i < 2500; ++i) EXPECT_EQ(corners[i].velocity, corners[i + 2500].velocity);
}

TEST(PlanCorners, FourierIsDrawnAnewForEachRealization) {
  const Motion motion = Read("fourier: {period: 10, harmonics: 5, speed: 1.5}");
  EXPECT_NE(Plan(motion, 5, 0)[100].velocity, Plan(motion, 5, 1)[100].velocity);
}

TEST(PlanCorners, MovesStayBetweenTheirLimitsAndPause) {
  const Motion motion = Read("moves: {between: [-1, 2], speed: 1, acceleration: 4, pause: 0.5}");
  const auto corners = Plan(motion, 60);
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

TEST(PlanCorners, ReadsBackWhatItWrites) {
  for (const char* yaml : {"fourier: {period: 10, harmonics: 5, speed: 1.5}\n  start: 0.2",
                           "moves: {between: [-1, 2], speed: 1, acceleration: 4, pause: 0.5}"}) {
    const Scenario scenario = ParseScenario(kRest + yaml, "motion");
    EXPECT_EQ(ParseScenario(ScenarioToYaml(scenario), "again").motion, scenario.motion) << yaml;
  }
}

TEST(PlanCorners, RefusesHalfAHarmonic) {
  EXPECT_THROW(Read("fourier: {period: 10, harmonics: 2.5, speed: 1}"), BadInput);
}

}  // namespace
}  // namespace warmjoint
