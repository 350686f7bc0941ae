#include "identification/preparation/take_ways.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "identification/preparation/prepare.h"
#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kStep = 0.1;        // s
constexpr double kAcceleration = 5;  // rad/s^2
constexpr double kCount = 9.587e-5;  // rad
constexpr int kHolds = 60;           // of 5 s
constexpr Index kSamples = 50 * kHolds;

/// A log at 10 Hz of speeds U(0.1, 1) rad/s to both sides, with ramps of 5 rad/s^2 that begin at a sample and end
/// between two, positions in 65,536 counts a turn, and the path that was travelled until each sample.
struct Driven {
  Measurements log;
  VectorXd path;  // [N] rad
};

Driven Drive() {
  RandomStream random({1, 6}, Stream::test);
  constexpr int parts = 2000;  // of a sampling interval: corners of the ramps are as exact
  const double dt = kStep / parts;
  Driven driven{{}, VectorXd(kSamples)};
  Measurements& log = driven.log;
  log.time = VectorXd::LinSpaced(kSamples, 0, kStep * (kSamples - 1));
  log.position.resize(kSamples);
  log.velocity.resize(kSamples);
  double v = 0, position = 0, path = 0, target = 0, until = 0;
  for (Index i = 0; i < kSamples; ++i) {
    log.position[i] = kCount * std::round(position / kCount);
    log.velocity[i] = v;
    driven.path[i] = path;
    for (int k = 0; k < parts; ++k) {
      if (log.time[i] + k * dt >= until) {
        target = (target > 0 ? -1 : 1) * random.Uniform(0.1, 1);
        until += 5;
      }
      const double next = v + std::clamp(target - v, -kAcceleration * dt, kAcceleration * dt);
      position += 0.5 * (v + next) * dt;
      path += 0.5 * std::abs(v + next) * dt;
      v = next;
    }
  }
  log.torque = 5 * log.velocity + 15 * log.velocity.cwiseSign();
  return driven;
}

/// The path between two times at which there are samples, with every velocity held until the next sample.
double HeldPath(const Measurements& m, double from, double to) {
  double path = 0;
  for (Index i = 0; m.time[i] < to; ++i) {
    if (m.time[i] >= from) path += std::abs(m.velocity[i]) * (m.time[i + 1] - m.time[i]);
  }
  return path;
}

TEST(TakeWays, LossesOfRampsAreThoseOfThePositions) {
  const auto [log, path] = Drive();
  const PreparedLog prepared = Prepare(log);
  EXPECT_TRUE(prepared.warnings().empty());

  // from the middle of the first segment to that of the last
  const auto& segments = prepared.taken().selection.segments;
  const auto middle = [](const Segment& segment) { return (segment.begin + segment.end) / 2; };
  const Index first = middle(segments.front()), last = middle(segments.back());
  const auto excess = [&](const Measurements& m) {
    return HeldPath(m, log.time[first], log.time[last]) / (path[last] - path[first]) - 1;
  };

  // speeds that are held until the next sample lack what ramps and reversals lose between two
  EXPECT_GT(std::abs(excess(log)), 1e-3);

  // a turn that is off by a count, each way: 60 sqrt(2) counts / sqrt(12) by chance, 5 deviations
  const double most = 5 * std::sqrt(2.0 * kHolds / 12) * kCount / (path[last] - path[first]);
  EXPECT_LT(std::abs(excess(prepared.steady().measurements)), most);
}

TEST(TakeWays, SegmentsKeepTheVelocityColumn) {
  const Measurements log = Drive().log;
  const PreparedLog prepared = Prepare(log);
  const auto& [m, selection] = prepared.steady();
  EXPECT_EQ(selection.count(), prepared.taken().selection.count());
  Index n = 0;
  for (Index i = 0; i < m.size(); ++i) {
    if (m.time[i] != log.time[n]) {
      EXPECT_FALSE(selection.keep[i]);
      continue;
    }
    EXPECT_EQ(selection.keep[i], prepared.taken().selection.keep[n]);
    if (selection.keep[i]) {
      EXPECT_EQ(m.velocity[i], log.velocity[n]);
    }
    ++n;
  }
  EXPECT_EQ(n, log.size());
  const auto& segments = prepared.taken().selection.segments;
  ASSERT_EQ(selection.segments.size(), segments.size());
  for (size_t i = 0; i < segments.size(); ++i) {
    EXPECT_EQ(m.time[selection.segments[i].begin], log.time[segments[i].begin]);
    // nothing is put in within a segment
    const Index length = segments[i].end - segments[i].begin;
    EXPECT_EQ(m.time[selection.segments[i].begin + length - 1], log.time[segments[i].end - 1]);
  }
}

}  // namespace
}  // namespace warmjoint
