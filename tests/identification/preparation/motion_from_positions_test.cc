#include "identification/preparation/motion_from_positions.h"

#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>

#include <cmath>
#include <numbers>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// A joint that holds speeds of U(0.1, 1) rad/s in turn both ways, with ramps between them, logged
/// without a velocity.
struct Drive {
  double rate = 20;         // Hz
  double hold = 5;          // s
  double acceleration = 3;  // rad/s^2; 0: jumps
  double pause = 0;         // s at rest between two speeds
  double ripple = 0;        // of the speed, three waves a second
  double resolution = 0;    // rad
  double origin = 0;        // rad
  std::uint64_t seed = 1;
  int speeds = 30;
};

struct Driven {
  Measurements log;
  VectorXd path;      // [N] rad, travelled until each sample
  VectorXd velocity;  // [N] rad/s
};

/// Integrated in steps of a thousandth of a sample or less.
Driven Carried(const Drive& drive) {
  RandomStream random({drive.seed, 5}, Stream::test);
  const auto n = static_cast<Index>(drive.speeds * drive.hold * drive.rate);
  const int parts = std::max(10, static_cast<int>(2000 / drive.rate));
  const double dt = 1 / drive.rate / parts;
  Driven driven{{}, VectorXd(n), VectorXd(n)};
  driven.log.time.resize(n);
  driven.log.position.resize(n);
  driven.log.torque = VectorXd::LinSpaced(n, 0, 1);
  double v = 0, position = 0, path = 0, target = 0, until = 0;
  int sign = 1;
  for (Index i = 0; i < n; ++i) {
    for (int k = 0; k < parts; ++k) {
      const double t = (static_cast<double>(i) + static_cast<double>(k) / parts) / drive.rate;
      if (t >= until - 1e-9) {
        target = sign * (0.1 + 0.9 * random.Uniform());
        sign = -sign;
        until += drive.hold;
      }
      const double left = until - t;
      const double wanted =
          left < drive.pause ? 0 : target * (1 + drive.ripple * std::sin(6 * std::numbers::pi * t));
      const double most = drive.acceleration > 0 ? drive.acceleration * dt : 10;
      v += std::clamp(wanted - v, -most, most);
      if (k == 0) {
        driven.log.time[i] = t;
        driven.log.position[i] = position;
        driven.path[i] = path;
        driven.velocity[i] = v;
      }
      position += v * dt;
      path += std::abs(v) * dt;
    }
  }
  if (drive.resolution > 0) {
    driven.log.position =
        drive.resolution * (driven.log.position / drive.resolution).array().round();
  }
  driven.log.position.array() += drive.origin;
  return driven;
}

double PathOf(const Measurements& m) {
  const Index n = m.size() - 1;
  return m.velocity.head(n).cwiseAbs().dot(m.time.tail(n) - m.time.head(n));
}

/// Of the whole path, how much too long the prepared log has it.
double Excess(const Drive& drive) {
  const Driven driven = Carried(drive);
  const double path = driven.path[driven.path.size() - 1];
  return PathOf(Prepare(driven.log).constant_speed().measurements) / path - 1;
}

TEST(MotionFromPositions, HasThePathOfTheJoint) {
  // what the gain would move by; half steps of a smoothed velocity made 0.2 to 4 %
  EXPECT_LT(std::abs(Excess({.rate = 1, .hold = 20, .acceleration = 0})), 5e-4);
  EXPECT_LT(std::abs(Excess({.rate = 5, .hold = 10})), 5e-4);
  EXPECT_LT(std::abs(Excess({.rate = 20})), 5e-4);
  EXPECT_LT(std::abs(Excess({.rate = 20, .resolution = 2 * std::numbers::pi / 4096})), 5e-4);
  EXPECT_LT(std::abs(Excess({.rate = 100, .resolution = 2 * std::numbers::pi / 1000})), 1e-3);
}

TEST(MotionFromPositions, HasThePathOfAJointThatPausesOrRipples) {
  EXPECT_LT(std::abs(Excess({.rate = 50, .hold = 2, .acceleration = 5, .pause = 0.3})), 5e-4);
  EXPECT_LT(std::abs(Excess({.rate = 100, .acceleration = 5, .ripple = 0.02})), 5e-4);
}

TEST(MotionFromPositions, HoldsOneSpeedForEachSegment) {
  const Driven driven = Carried({});
  const LogView steady = Prepare(driven.log).constant_speed();
  ASSERT_EQ(steady.selection.segments.size(), 30U);
  for (const Segment& segment : steady.selection.segments) {
    for (Index i = segment.begin; i + 1 < segment.end; ++i) {
      // the last step of a segment is told by the difference of two positions
      EXPECT_NEAR(steady.measurements.velocity[i], segment.velocity, 1e-9);
    }
  }
}

TEST(MotionFromPositions, KeepsNoSampleOfARampAndNearlyAllOthers) {
  for (const double resolution : {0.0, 2 * std::numbers::pi / 4096}) {
    const Driven driven = Carried({.resolution = resolution});
    const LogView steady = Prepare(driven.log).constant_speed();
    Index taken = 0, constant = 0, kept = 0;
    for (Index i = 0; i < steady.measurements.size(); ++i) {
      while (taken + 1 < driven.log.size() &&
             driven.log.time[taken] < steady.measurements.time[i]) {
        ++taken;
      }
      if (!steady.selection.keep[i]) continue;
      ++kept;
      EXPECT_NEAR(steady.measurements.velocity[i], driven.velocity[taken], 0.01);
    }
    for (Index i = 1; i < driven.log.size(); ++i) {
      constant += driven.velocity[i] == driven.velocity[i - 1];
    }
    EXPECT_GT(kept, 0.93 * static_cast<double>(constant));
  }
}

TEST(MotionFromPositions, DoesNotDependOnWhereTheEncoderHasItsZero) {
  Drive drive{.resolution = 2 * std::numbers::pi / 4096};
  const LogView here = Prepare(Carried(drive).log).constant_speed();
  drive.origin = 200 * std::numbers::pi;
  const LogView there = Prepare(Carried(drive).log).constant_speed();
  EXPECT_TRUE((here.selection.keep == there.selection.keep).all());
  // the rounding of 628 rad over that of the way of a segment
  const Eigen::ArrayXd apart = here.measurements.velocity - there.measurements.velocity;
  EXPECT_LT(here.selection.keep.select(apart.abs(), 0.0).maxCoeff(), 1e-9);
}

TEST(MotionFromPositions, TakesJoinedRecordingsOneByOne) {
  const Measurements one = Carried({.seed = 1}).log, other = Carried({.rate = 100, .seed = 2}).log;
  const LogView alone = Prepare(other).constant_speed();
  const LogView joined = Prepare(std::vector{one, other}).constant_speed();
  const Index n = alone.measurements.size();
  ASSERT_EQ(joined.measurements.starts.size(), 1U);
  ASSERT_EQ(joined.measurements.size() - joined.measurements.starts[0], n);
  EXPECT_TRUE((joined.selection.keep.tail(n) == alone.selection.keep).all());
  EXPECT_LT(
      (joined.measurements.velocity.tail(n) - alone.measurements.velocity).cwiseAbs().maxCoeff(),
      1e-9);
}

TEST(MotionFromPositions, DoesNotLookAcrossAGap) {
  Measurements log = Carried({}).log;
  const Index n = log.size() / 2;
  log.time.tail(n).array() += 100;
  const LogView steady = Prepare(log).constant_speed();
  for (const Segment& segment : steady.selection.segments) {
    for (Index i = segment.begin + 1; i < segment.end; ++i) {
      EXPECT_LT(steady.measurements.time[i] - steady.measurements.time[i - 1], 1);
    }
  }
}

}  // namespace
}  // namespace warmjoint
