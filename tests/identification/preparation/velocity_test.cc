#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>

#include <cmath>
#include <numbers>

#include "identification/preparation/motion_from_positions.h"
#include "identification/preparation/moving_view.h"
#include "models/foundation/random_stream.h"
#include "models/foundation/robust_noise.h"
#include "tests/support/vectors.h"

namespace warmjoint {
namespace {

using Eigen::VectorXd;

constexpr double kPi = std::numbers::pi;

VectorXd Times(int n, double rate) { return VectorXd::LinSpaced(n, 0, (n - 1) / rate); }

TEST(DeriveVelocity, FollowsASinusoidInThePassBand) {
  const VectorXd time = Times(4000, 1000);
  const double w = 2 * kPi * 5;  // rad/s
  const VectorXd position = (w * time.array()).sin();
  const VectorXd expected = w * (w * time.array()).cos();
  const VectorXd velocity = DeriveVelocity(time, position, 100);
  // central differences lose (w h)^2 / 6 = 1.6e-4 of the slope, the filter twice (5/100)^8 / 2
  const auto inner = (velocity - expected).segment(100, 3800).cwiseAbs();
  EXPECT_LT(inner.maxCoeff(), 1.7e-4 * w);
}

TEST(ChooseCutoff, HoldsTheNoiseOfTheVelocityAtOnePercent) {
  RandomStream random({5, 6}, Stream::test);
  const VectorXd time = Times(20000, 1000);
  const VectorXd clean = (2 * time.array()).sin();
  for (const double noise : {1e-4, 5e-4}) {
    VectorXd position = clean;
    for (double& p : position) p += noise * random.Normal();
    const double cutoff = ChooseCutoff(time, position);
    ASSERT_LT(cutoff, 100);
    ASSERT_GT(cutoff, 20) << "not the floor";

    const VectorXd error =
        DeriveVelocity(time, position, cutoff) - DeriveVelocity(time, clean, cutoff);
    const double rms = std::sqrt(error.squaredNorm() / 20000.0);
    // 1 % of 2 / sqrt(2); a Butterworth run twice passes 0.9 of the power of an ideal low-pass
    EXPECT_NEAR(rms, 0.01 * std::sqrt(2.0), 0.15 * 0.01 * std::sqrt(2.0)) << noise;
  }
}

/// n samples of v = sin(w t), h apart, with white noise on the velocity.
Measurements Sine(Eigen::Index n, double h, double w, double noise = 0) {
  const Eigen::VectorXd time = h * Eigen::VectorXd::LinSpaced(n, 0, static_cast<double>(n - 1));
  Measurements m = test::Record(h, (w * time.array()).sin().matrix(), Eigen::VectorXd::Zero(n));
  RandomStream random({1, 0}, Stream::velocity_noise);
  for (double& v : m.velocity) v += noise * random.Normal();
  return m;
}

/// Of the acceleration, over all but the first and last samples, rad/s^2.
double RmsError(const LogView& view, double w, Eigen::Index ends) {
  const LogSamples& m = view.measurements;
  const Eigen::ArrayXd truth = w * (w * m.time.array()).cos();
  const Eigen::Index n = m.size() - 2 * ends;
  const Eigen::ArrayXd error = m.acceleration->array() - truth;
  return std::sqrt(error.segment(ends, n).square().mean());
}

TEST(MovingView, DifferentiatesASmoothVelocity) {
  // differences of fourth order miss w cos by its share (w h)^4 / 30 = 3.3e-10
  EXPECT_LT(RmsError(ViewMotion(Sine(1000, 0.01, 1)), 1, 2), 3.4e-10);
}

TEST(MovingView, DifferentiatesUnevenSamples) {
  // steps of 9.8 and 10.2 ms: the fifth derivative over 5!, times the ways to the four other samples
  Measurements m = Sine(1000, 0.01, 1);
  for (Eigen::Index i = 1; i < m.size(); i += 2) m.time[i] -= 0.0002;
  m.velocity = m.time.array().sin();
  EXPECT_LT(RmsError(ViewMotion(m), 1, 2), 0.0098 * 0.0102 * 0.02 * 0.02 / 120);
}

TEST(MovingView, FollowsANoisyVelocityByPolynomials) {
  // 0.01 at 100 Hz would leave 0.7 of an acceleration of 0.7 rms; polynomials leave 0.05 of that
  const LogView view = ViewMotion(Sine(4000, 0.01, 1, 0.01));
  EXPECT_LT(RmsError(view, 1, 64), 0.05 * std::sqrt(0.5));
  EXPECT_FALSE(view.selection.keep[0]);
}

TEST(MovingView, KeepsWhatMovesClearlyAndAlike) {
  const Measurements sine = Sine(1000, 0.01, 1);
  const LogView view = ViewMotion(sine);
  EXPECT_NEAR(ClearSpeed(sine), 0.05 * std::sqrt(0.5), 0.002);
  for (Eigen::Index i = 0; i < 1000; ++i) {
    const double v = view.measurements.velocity[i];
    const bool kept = view.selection.keep[i];
    EXPECT_TRUE(!kept || std::abs(v) > ClearSpeed(sine)) << i;
    EXPECT_TRUE(kept || std::abs(v) < 0.1 || i == 0 || i == 999) << i;
  }
}

TEST(MovingView, LeavesOutCornersOfTheVelocity) {
  // up for a second, steady for one, down for one: the slope at a corner is that of neither side
  Eigen::VectorXd velocity(300);
  for (Eigen::Index i = 0; i < 300; ++i) {
    velocity[i] = i < 100   ? 0.01 * static_cast<double>(i)
                  : i < 200 ? 1
                            : 3 - 0.01 * static_cast<double>(i);
  }
  const LogView view = ViewMotion(test::Record(0.01, velocity, Eigen::VectorXd::Zero(300)));
  EXPECT_FALSE(view.selection.keep[100]);
  EXPECT_FALSE(view.selection.keep[200]);
  EXPECT_TRUE(view.selection.keep[50]);
  EXPECT_TRUE(view.selection.keep[150]);
}

/// Moves that speed up and slow down, with rests between: positions are exact, and the velocity has an offset.
Measurements Moves(double offset) {
  Eigen::VectorXd velocity(4000);
  for (Eigen::Index i = 0; i < velocity.size(); ++i) {
    const auto phase = static_cast<double>(i % 200);  // of 2 s, of which a half moves
    const double sign = i / 200 % 2 ? -1 : 1;
    velocity[i] = phase < 100 ? sign * std::pow(std::sin(0.01 * std::numbers::pi * phase), 2) : 0;
  }
  Measurements m = test::Record(0.01, velocity, Eigen::VectorXd::Zero(4000));
  m.position += 0.005 * velocity;  // by trapezoids
  m.velocity.array() += offset;
  return m;
}

TEST(PreparedLog, RestsOfAColumnWithAnOffsetHoldNoSpeed) {
  EXPECT_FALSE(Prepare(Moves(0)).holds_speeds());
  EXPECT_FALSE(Prepare(Moves(0.02)).holds_speeds());
  EXPECT_FALSE(Prepare(Moves(0.1)).holds_speeds());
}

TEST(PreparedLog, MotionOfAnyKindTakesThePositionsOfAColumnThatIsOffOrLate) {
  using testing::ElementsAre, testing::HasSubstr, testing::IsEmpty;
  EXPECT_THAT(Prepare(Moves(0)).moving_warnings(), IsEmpty());
  for (const double offset : {0.02, 0.1}) {
    const PreparedLog off = Prepare(Moves(offset));
    EXPECT_THAT(off.moving_warnings(),
                ElementsAre(HasSubstr(fmt::format("off by {} rad/s", offset))));
    EXPECT_LT(std::abs(off.moving().measurements.velocity[150]), 0.01);
  }
  Measurements late = Moves(0);
  const Eigen::VectorXd velocity = late.velocity;
  late.velocity.tail(3998) = velocity.head(3998);
  EXPECT_THAT(Prepare(late).moving_warnings(), ElementsAre(HasSubstr("lags its positions by 2")));
}

TEST(PreparedLog, TellsWhetherItHoldsSpeeds) {
  EXPECT_FALSE(Prepare(Sine(2000, 0.01, 1)).holds_speeds());
  Eigen::VectorXd holds(400);
  for (Eigen::Index i = 0; i < 400; ++i) holds[i] = i / 40 % 2 ? -0.5 : 1;
  EXPECT_TRUE(Prepare(test::Record(1, holds, Eigen::VectorXd::Zero(400))).holds_speeds());
}

/// Motion of a hand: sines of several periods of seconds, or holds of 2 s, with noise of the velocity that hides part of it.
enum class NoisyMotion { holds, smooth };
Measurements HiddenByNoise(NoisyMotion motion) {
  const bool held = motion == NoisyMotion::holds;
  RandomStream noise({5, held}, Stream::test);
  Eigen::VectorXd velocity(12000);
  for (Eigen::Index i = 0; i < velocity.size(); ++i) {
    const double t = 0.016 * static_cast<double>(i);
    const double smooth = 0.5 * std::sin(0.9 * t) + 0.3 * std::sin(2.3 * t + 1);
    const double steady = (i / 125 % 2 ? -0.2 : 0.2) * static_cast<double>(1 + i / 250 % 3);
    velocity[i] = held ? steady : smooth;
  }
  Measurements m = test::Record(0.016, velocity, Eigen::VectorXd::Zero(velocity.size()));
  for (double& v : m.velocity) v += 0.01 * noise.Normal();
  return m;
}

TEST(PreparedLog, PiecesOfASmoothMotionThatNoiseHidesHoldNoSpeed) {
  EXPECT_FALSE(Prepare(HiddenByNoise(NoisyMotion::smooth)).holds_speeds());
  EXPECT_TRUE(Prepare(HiddenByNoise(NoisyMotion::holds)).holds_speeds());
}

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
