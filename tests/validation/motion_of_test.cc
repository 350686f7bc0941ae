#include <gmock/gmock.h>

#include <cmath>

#include "identification/preparation/select.h"
#include "models/foundation/bad_input.h"
#include "sim/plant/plant.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// 10 s at 1, a second of a sine to -2, 10 s at -2, at 100 Hz, starting at 3 rad and 50 s.
Measurements TwoSpeeds() {
  const Eigen::Index n = 2101;
  Measurements m;
  m.source = "log.csv";
  m.time.resize(n);
  m.velocity.resize(n);
  m.position.resize(n);
  m.torque = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t = 0.01 * static_cast<double>(i);
    m.time[i] = 50 + t;
    m.velocity[i] = t <= 10 ? 1 : t >= 11 ? -2 : -0.5 + 1.5 * std::cos(M_PI * (t - 10));
    m.position[i] = i == 0 ? 3 : m.position[i - 1] + 0.005 * (m.velocity[i] + m.velocity[i - 1]);
  }
  return m;
}

double PositionAt(const Motion& motion, double time) {
  double position = motion.start;
  for (size_t i = 1; i < motion.corners.size(); ++i) {
    const VelocityCorner& from = motion.corners[i - 1];
    const VelocityCorner& to = motion.corners[i];
    if (from.time >= time) break;
    const double end = std::min(to.time, time);
    const double share = (end - from.time) / (to.time - from.time);
    const double at_end = from.velocity + share * (to.velocity - from.velocity);
    position += (end - from.time) * (from.velocity + at_end) / 2;
  }
  return position;
}

TEST(MotionOf, FollowsSegmentsAndTheWayBetweenThem) {
  const Measurements m = TwoSpeeds();
  const Motion motion = MotionOf(m, SelectConstantSpeed(m));
  EXPECT_EQ(motion.start, 3);
  EXPECT_EQ(motion.corners.front().time, 0);
  EXPECT_NEAR(motion.corners.back().time, 21, 1e-9);
  EXPECT_NEAR(motion.corners.front().velocity, 1, 1e-9);
  EXPECT_NEAR(motion.corners.back().velocity, -2, 1e-9);
  for (size_t i = 1; i < motion.corners.size(); ++i) {
    EXPECT_GT(motion.corners[i].time, motion.corners[i - 1].time);
  }

  // exact in the segments; on the way, a line misses a sine of 1.5 rad/s by 1.5 (pi h)^2/8 at
  // steps of 0.11 s
  for (Eigen::Index i = 0; i < m.size(); i += 10) {
    const double t = m.time[i] - 50;
    const double tolerance = t > 9.9 && t < 11.1 ? 0.03 : 1e-9;
    EXPECT_NEAR(PositionAt(motion, t), m.position[i], tolerance) << t;
  }
}

TEST(MotionOf, RefusesARecordingWithoutConstantSpeed) {
  Measurements m = TwoSpeeds();
  m.velocity = (3 * m.time).array().sin();
  EXPECT_THAT([&] { MotionOf(m, SelectConstantSpeed(m)); },
              ThrowsMessage<BadInput>(HasSubstr("no segment at constant speed")));
}

}  // namespace
}  // namespace warmjoint
