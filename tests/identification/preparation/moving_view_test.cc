#include "identification/preparation/moving_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

/// Speed that goes up and down between -1 and 1 rad/s, 4 s a period, by straight lines or as a sine.
/// Positions are exact; both are sampled every h from `phase` on, s.
struct Swing {
  double h = 0.05;
  double phase = 0.013;
  bool straight = true;
};

double VelocityAt(const Swing& swing, double t) {
  if (!swing.straight) return std::sin(std::numbers::pi / 2 * t);
  const double part = std::fmod(t, 4);  // corners at 1 s and 3 s
  return part < 1 ? part : part < 3 ? 2 - part : part - 4;
}

/// Integral of the velocity from 0, rad.
double PositionAt(const Swing& swing, double t) {
  if (!swing.straight) return (1 - std::cos(std::numbers::pi / 2 * t)) / (std::numbers::pi / 2);
  const double part = std::fmod(t, 4);
  if (part < 1) return part * part / 2;
  if (part < 3) return 1 - (2 - part) * (2 - part) / 2;
  return (4 - part) * (4 - part) / 2;
}

/// The recording of n samples.
Measurements Sampled(const Swing& swing, Eigen::Index n) {
  Measurements m;
  m.time = swing.h * Eigen::VectorXd::LinSpaced(n, 0, static_cast<double>(n - 1));
  m.velocity = m.time.unaryExpr([&](double t) { return VelocityAt(swing, swing.phase + t); });
  m.position = m.time.unaryExpr([&](double t) { return PositionAt(swing, swing.phase + t); });
  m.torque = Eigen::VectorXd::Zero(n);
  return m;
}

/// The sum of mean speed times interval over all but the last sample, rad.
double WayOf(const Measurements& m, const Eigen::VectorXd& speed) {
  return (m.time.tail(m.size() - 1) - m.time.head(m.size() - 1)).dot(speed.head(m.size() - 1));
}

/// Loss of kv |v| + kc over what moves at the means between samples, J.
double LossOf(const Measurements& m, double viscous, double coulomb) {
  const BetweenSamples between = MeansBetween(m, {{0, m.size()}}, 0.05);
  const Eigen::VectorXd force = (viscous * between.loss_velocity.array().abs() + coulomb).matrix();
  return WayOf(m, between.mean_speed.cwiseProduct(force));
}

constexpr double kClear = 0.05;  // rad/s

TEST(BetweenSamples, SumsToTheWayOfAJointThatTurnsBetweenSamples) {
  // 100 turns in 100 periods, 4 rad each where straight, 8 / pi where a sine
  for (const double phase : {0.0, 0.013, 0.025, 0.041}) {
    for (const bool straight : {true, false}) {
      const Swing swing{.phase = phase, .straight = straight};
      const Measurements m = Sampled(swing, 100 * 80 + 1);
      const double way = 100 * (straight ? 2 : 8 / std::numbers::pi);
      // exact but for what bends within the few samples slower than kClear: (pi / 2)^3 h^3 / 12 of a
      // turn, two turns a period
      EXPECT_NEAR(WayOf(m, MeansBetween(m, {{0, m.size()}}, kClear).mean_speed), way, 1e-4 * way)
          << phase << ' ' << straight;
    }
  }
}

TEST(BetweenSamples, GiveTheLossOfAStraightLineOverSpeed) {
  // of 5 v^2 + 15 |v|, v from -1 to 1 and back at 1 rad/s^2: 5/3 and 15/2 a second
  for (const double phase : {0.0, 0.013, 0.025, 0.041}) {
    const Measurements m = Sampled({.phase = phase}, 100 * 80 + 1);
    // a corner between two samples takes a way of up to h^2 / 4 off straight lines, at 1 rad/s, and
    // the scale spreads it over a stretch of 1 rad whose v^2 is 2/3 per rad: what 5 v^2 misses is at
    // most 5 (2 - 4/3) h^2 / 4 of the stretch's 55/3 J
    EXPECT_NEAR(LossOf(m, 5, 15) / (400 * (5.0 / 3 + 15.0 / 2)), 1,
                5 * (2.0 / 3) * 0.05 * 0.05 / 4 / (55.0 / 3))
        << phase;
  }
}

TEST(BetweenSamples, KeepsToTheVelocityWherePositionsContradictIt) {
  Measurements m = Sampled({}, 801);
  const Eigen::VectorXd speed = MeansBetween(m, {{0, m.size()}}, kClear).mean_speed;
  m.position *= 100;
  EXPECT_NEAR(WayOf(m, MeansBetween(m, {{0, m.size()}}, kClear).mean_speed), WayOf(m, speed), 0.01);
}

TEST(BetweenSamples, CountsTheWayAfterASampleAtRestWithTheNext) {
  Measurements m;
  m.time = Eigen::VectorXd::LinSpaced(4, 0, 3);
  m.velocity = Eigen::Vector4d(-2, 0, 2, 2);
  m.position = Eigen::Vector4d(1, 0, 1, 3);
  m.torque = Eigen::VectorXd::Zero(4);
  EXPECT_EQ(MeansBetween(m, {{0, 4}}, kClear).mean_speed, Eigen::Vector4d(1, 0, 3, 2));
}

}  // namespace
}  // namespace warmjoint
