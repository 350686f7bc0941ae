// Ramps that no sample shows, by hand.
#include "identification/preparation/share_acceleration.h"

#include <gtest/gtest.h>

#include <cmath>

namespace warmjoint {
namespace {

using Changes = std::vector<std::optional<SpeedChange>>;

/// From 0 to `leap`, rad/s, at a time and within a duration, s.
SpeedChange Change(double time, double leap, double duration) {
  SpeedChange change;
  change.behind.velocity = leap;
  change.time = time;
  change.duration = duration;
  return change;
}

/// Ramps of the accelerations given, rad/s^2, and behind them one that did not show: 1 rad/s at 100.1 s.
Changes Ramps(const std::vector<double>& accelerations) {
  Changes changes;
  for (double a : accelerations)
    changes.push_back(Change(10 * static_cast<double>(changes.size()), 2, 2 / a));
  changes.push_back(std::nullopt);
  changes.push_back(Change(100.1, 1, 0));
  return changes;
}

/// How long the last ramp is taken to be, where a joint is sampled each `step`, s.
double Last(Changes changes, double step) {
  const auto count = static_cast<Eigen::Index>(std::lround(200 / step)) + 1;
  ShareAcceleration(Eigen::VectorXd::LinSpaced(count, 0, 200), changes);
  EXPECT_FALSE(changes[changes.size() - 2]) << "what was no change stays none";
  return changes.back()->duration;
}

TEST(ShareAcceleration, GivesARampThatOfTheOthers) {
  // 1 rad/s at 8 rad/s^2, the median
  EXPECT_DOUBLE_EQ(Last(Ramps({8, 8.1, 7.9, 8, 8}), 1), 0.125);
}

TEST(ShareAcceleration, ARampEndsBeforeTheNearestSample) {
  // at 2 rad/s^2 it would take 0.5 s, but 0.1 s before its middle a sample shows none of it
  EXPECT_NEAR(Last(Ramps({2, 2, 2, 2, 2}), 1), 0.2, 1e-12);
}

TEST(ShareAcceleration, FewRampsOrUnequalOnesTellNothing) {
  EXPECT_EQ(Last(Ramps({8, 8, 8, 8}), 1), 0);
  EXPECT_EQ(Last(Ramps({2, 4, 8, 16, 32}), 1), 0);
}

TEST(ShareAcceleration, ARampThatShowsStaysAsItWas) {
  Changes changes = Ramps({8, 8, 8, 8, 16});
  ShareAcceleration(Eigen::VectorXd::LinSpaced(201, 0, 200), changes);
  EXPECT_DOUBLE_EQ(changes[4]->duration, 0.125);
}

TEST(ShareAcceleration, NothingIsAskedOfTimesOutsideTheLog) {
  Changes changes = Ramps({8, 8, 8, 8, 8});
  changes.back()->time = 300;
  ShareAcceleration(Eigen::VectorXd::LinSpaced(201, 0, 200), changes);
  EXPECT_EQ(changes.back()->duration, 0);
}

}  // namespace
}  // namespace warmjoint
