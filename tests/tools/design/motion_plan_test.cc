#include "tools/design/motion_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

/// Blocks of 20 s at speeds between the limits, or at rest, by chance.
std::vector<SpeedBlock> SomeBlocks(const MotionLimits& limits, RandomStream& random) {
  std::vector<SpeedBlock> blocks;
  for (int i = 0; i < 30; ++i) {
    const bool rests = random.Below(5) == 0;
    blocks.push_back({20, rests ? 0 : random.Uniform(limits.velocity[0], limits.velocity[1])});
  }
  return blocks;
}

TEST(MotionPlan, KeepsToItsLimitsWhateverTheyAre) {
  RandomStream random({11, 0}, Stream::test);
  for (int k = 0; k < 200; ++k) {
    MotionLimits limits;
    const double fastest = random.Uniform(0.2, 3);
    limits.velocity = {fastest * random.Uniform(0.01, 0.5), fastest};
    limits.acceleration = fastest / random.Uniform(0.05, 1);  // at its fastest within a second
    // room for strokes at the fastest speed
    const double room = fastest * fastest / limits.acceleration * random.Uniform(6, 60);
    const double lower = random.Uniform(-3, 3);
    limits.position = {lower, lower + room};
    const auto knots = LayOut(SomeBlocks(limits, random), limits, random.Uniform(2, 20));

    EXPECT_NEAR(knots.back().time, 600, 1e-6);
    EXPECT_EQ(knots.back().velocity, 0);
    double moves = 0;
    for (size_t i = 1; i < knots.size(); ++i) {
      const MotionKnot &from = knots[i - 1], &to = knots[i];
      const double lasts = to.time - from.time;
      ASSERT_GT(lasts, 0) << i;
      // between knots the velocity keeps its sign, so that knots are the farthest places
      EXPECT_GE(from.velocity * to.velocity, 0);
      EXPECT_GE(to.position, lower - 1e-9);
      EXPECT_LE(to.position, lower + room + 1e-9);
      EXPECT_LE(std::abs(to.velocity), fastest);
      EXPECT_LE(std::abs(to.velocity - from.velocity), limits.acceleration * lasts * (1 + 1e-6));
      EXPECT_NEAR(to.position - from.position, lasts * (from.velocity + to.velocity) / 2, 1e-9);
      if (to.velocity == from.velocity && to.velocity != 0) moves += lasts;
    }
    // most of the time it moves as asked
    EXPECT_GT(moves, 200);
  }
}

TEST(MotionPlan, KeepsToItsLimitsInFilesAsWell) {
  RandomStream random({13, 0}, Stream::test);
  const auto rounded = [](double value) { return std::round(1e9 * value) / 1e9; };
  for (int k = 0; k < 20; ++k) {
    const double fastest = random.Uniform(0.05, 3), room = fastest * random.Uniform(1.3, 4);
    const MotionLimits limits{.position = std::array{0.0, room},
                              .velocity = {fastest / 20, fastest},
                              .acceleration = 5 * fastest};
    const auto knots = LayOut(SomeBlocks(limits, random), limits, 10);
    EXPECT_EQ(knots.back().time, 600);
    // a simulation of the file goes where its times and velocities lead
    double place = rounded(knots[0].position);
    for (size_t i = 1; i < knots.size(); ++i) {
      const double lasts = rounded(knots[i].time) - rounded(knots[i - 1].time);
      place += lasts * (rounded(knots[i].velocity) + rounded(knots[i - 1].velocity)) / 2;
      ASSERT_GE(place, -1e-12) << i;
      ASSERT_LE(place, room + 1e-12) << i;
    }
  }
}

TEST(MotionPlan, LeadsSlowSpeedsToManyPlaces) {
  MotionLimits limits{.position = std::array{-2.0, 2.0}};
  const std::vector<SpeedBlock> blocks(60, {20, 0.05});
  const auto knots = LayOut(blocks, limits, 10);
  const auto [least, most] = std::ranges::minmax(knots, {}, &MotionKnot::position);
  EXPECT_GT(most.position - least.position, 3);
}

TEST(MotionPlan, CellsHoldTheWayTheSquaresAndTheTimeAtConstantSpeed) {
  const MotionLimits limits{.position = std::array{-0.7, 0.9}, .acceleration = 2};
  RandomStream random({12, 0}, Stream::test);
  const auto knots = LayOut(SomeBlocks(limits, random), limits, 7);
  double way = 0, squares = 0, held = 0;
  for (size_t i = 1; i < knots.size(); ++i) {
    const double a = knots[i - 1].velocity, b = knots[i].velocity;
    const double lasts = knots[i].time - knots[i - 1].time;
    way += lasts * std::abs(a + b) / 2;
    squares += lasts * (a * a + a * b + b * b) / 3;
    if (a == b && a != 0) held += lasts;
  }
  for (const double length : {0.5, 2.0, 6.0}) {
    const MotionCells cells = CellsOf(knots, length);
    EXPECT_NEAR(length * cells.mean_speed.sum(), way, 1e-6 * way);
    EXPECT_NEAR(length * cells.mean_speed.dot(cells.loss_velocity.cwiseAbs()), squares,
                1e-6 * squares);
    EXPECT_NEAR(cells.held.sum(), held, 1e-6 * held);
  }
}

}  // namespace
}  // namespace warmjoint
