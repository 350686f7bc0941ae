#include "identification/preparation/speed_change.h"

#include <gtest/gtest.h>

#include <cmath>

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// 0.8 rad/s until a ramp to -0.5 rad/s around 5.03 s, for 10 s.
struct Turn {
  double duration = 0.4;  // s
  double step = 0.05;     // s
  double middle = 5.03;   // s

  double At(double t) const {
    const double begin = middle - duration / 2, since = t - begin;
    if (since <= 0) return 0.8 * t;
    if (since < duration) return 0.8 * t - 1.3 / (2 * duration) * since * since;
    return 0.8 * middle - 0.5 * (t - middle);
  }
  VectorXd Time() const { return VectorXd::LinSpaced(static_cast<Index>(10 / step) + 1, 0, 10); }
  VectorXd Position(double resolution) const {
    VectorXd p = Time().unaryExpr([&](double t) { return At(t); });
    if (resolution > 0) p = resolution * (p / resolution).array().round();
    return p;
  }
};

std::optional<SpeedChange> Find(const Turn& turn, double resolution) {
  const VectorXd time = turn.Time(), position = turn.Position(resolution);
  const PositionNoise noise = MeasurePositionNoise(position);
  const Eigen::Array<bool, Eigen::Dynamic, 1> all =
      Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(time.size(), true);
  const auto index = [&](double t) { return static_cast<Index>(std::lround(t / turn.step)); };
  auto before = FitPositionLine(time, position, 0, index(4.5), all);
  auto behind = FitPositionLine(time, position, index(5.5), time.size() - 1, all);
  for (auto* line : {&*before, &*behind}) {
    line->deviation = std::max(line->deviation, noise.deviation);
  }
  return FindSpeedChange(time, position, *before, *behind, index(3.5), index(6.5), noise);
}

TEST(SpeedChange, FindsWhereARampIsAndHowLong) {
  const auto change = Find({}, 0);
  ASSERT_TRUE(change);
  // 1e-9 of the range over a speed of 1.3 rad/s, and the square root of that for the duration
  EXPECT_NEAR(change->time, 5.03, 1e-8);
  EXPECT_NEAR(change->duration, 0.4, 1e-4);
}

TEST(SpeedChange, FindsARampThroughACoarseEncoder) {
  const double resolution = 0.005;  // rad
  const auto change = Find({}, resolution);
  ASSERT_TRUE(change);
  EXPECT_NEAR(change->time, 5.03, resolution / 1.3);
  EXPECT_NEAR(change->duration, 0.4, 0.1);
  EXPECT_GE(change->margin, resolution / 2 / 1.3);
}

TEST(SpeedChange, CallsAJumpBetweenTwoSamplesAJump) {
  for (const double resolution : {0.0, 1e-4}) {
    const auto change = Find({1e-12, 0.05, 5.03}, resolution);
    ASSERT_TRUE(change);
    EXPECT_EQ(change->duration, 0);
    EXPECT_NEAR(change->time, 5.03, 1e-4);
  }
}

TEST(SpeedChange, FollowsThePositionsThroughout) {
  const Turn turn;
  const auto change = Find(turn, 0);
  ASSERT_TRUE(change);
  for (const double t : {4.0, 4.9, 5.0, 5.1, 5.2, 6.0})
    EXPECT_NEAR(change->At(t), turn.At(t), 1e-4);
}

TEST(SpeedChange, IsNoneWhereTheJointPauses) {
  // it stands for 0.5 s in the middle
  const VectorXd time = VectorXd::LinSpaced(201, 0, 10);
  const VectorXd position =
      time.unaryExpr([](double t) { return t < 5 ? 0.8 * t : 4 - 0.5 * std::max(t - 5.5, 0.0); });
  const auto all = Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(201, true);
  const auto before = FitPositionLine(time, position, 0, 90, all);
  const auto behind = FitPositionLine(time, position, 120, 200, all);
  EXPECT_FALSE(
      FindSpeedChange(time, position, *before, *behind, 80, 130, MeasurePositionNoise(position)));
}

}  // namespace
}  // namespace warmjoint
