#include "identification/preparation/local_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "models/foundation/random_stream.h"
#include "tests/support/vectors.h"

namespace warmjoint {
namespace {

constexpr double kStep = 0.02;  // s

/// Velocity of moves to and fro: 6 rad/s^2 up to 1.5 rad/s, steady, down again and back, 2 s a move.
double MoveVelocity(double t) {
  const double part = std::fmod(t, 2), size = std::min({6 * part, 1.5, 6 * (2 - part)});
  return std::fmod(t, 4) < 2 ? size : -size;
}

double MoveAcceleration(double t) {
  const double part = std::fmod(t, 2), side = std::fmod(t, 4) < 2 ? 1 : -1;
  return part < 0.25 ? 6 * side : part > 1.75 ? -6 * side : 0;
}

/// 8000 samples with noise on velocity and position.
Measurements Moves(double velocity_noise, double position_noise) {
  const Eigen::Index n = 8000;
  Measurements m;
  m.time = kStep * Eigen::VectorXd::LinSpaced(n, 0, static_cast<double>(n - 1));
  m.velocity = m.time.unaryExpr([](double t) { return MoveVelocity(t + 0.007); });
  m.position = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 1; i < n; ++i) {
    // by trapezoids of a hundredth of the step
    double way = 0;
    for (int k = 0; k < 100; ++k)
      way += MoveVelocity(m.time[i - 1] + 0.007 + kStep * (k + 0.5) / 100);
    m.position[i] = m.position[i - 1] + way * kStep / 100;
  }
  RandomStream random({3, 0}, Stream::velocity_noise);
  for (double& v : m.velocity) v += velocity_noise * random.Normal();
  for (double& p : m.position) p += position_noise * random.Normal();
  m.torque = Eigen::VectorXd::Zero(n);
  return m;
}

/// Errors of the acceleration where it is known, rad/s^2, and where it is not.
struct Errors {
  double rms_when_steady = 0;  // 0.3 s or more from a ramp
  double mean_in_ramps = 0;    // below 0 where the acceleration comes out too small
  double known = 0;            // share of all samples
};

Errors ErrorsOf(const Measurements& m, const LocalMotion& motion) {
  Errors errors;
  double steady = 0, ramps = 0;
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    if (!motion.known[i]) continue;
    errors.known += 1.0 / static_cast<double>(m.size());
    const double part = std::fmod(m.time[i] + 0.007, 2),
                 truth = MoveAcceleration(m.time[i] + 0.007);
    const double error = motion.acceleration[i] - truth;
    if (truth != 0) {
      ramps += 1;
      errors.mean_in_ramps += truth > 0 ? error : -error;
    } else if (part > 0.55 && part < 1.45) {
      steady += 1;
      errors.rms_when_steady += error * error;
    }
  }
  errors.rms_when_steady = std::sqrt(errors.rms_when_steady / steady);
  errors.mean_in_ramps /= ramps;
  return errors;
}

/// A quarter of the samples accelerate by 6 rad/s^2: 3 rad/s^2 rms, of which a twentieth may be noise.
constexpr double kAcceptedError = kAcceptedNoise * 3;

/// Ramps of 12 samples between corners. A window of half width 4, the narrowest of those that follow
/// noise of 0.02 rad/s with a fifth of 6 rad/s^2, sees a corner in 8 of them; where it cannot be told
/// from noise, half of the change is missed on the way across, at most a quarter of it on average over
/// these: 8 / 12 of a quarter of 6 rad/s^2 would be 1, and most are told.
constexpr double kAcrossCorners = 0.5;

/// Two corners in 100 samples. The widest of the windows that are the narrowest to follow one of these
/// noises reaches 6 samples to each side, and the neighbours of what it bends are left out, too: 2 x 7 + 1
/// samples a corner; and the ends.
constexpr double kKnown = 1 - 2 * 15 / 100.0 - 0.01;

TEST(LocalMotion, KeepsCornersOfANoisyVelocity) {
  const Measurements m = Moves(0.02, 0);
  const Errors errors = ErrorsOf(m, FollowLocally(m, {{0, m.size()}}, MotionSource::velocity));
  EXPECT_LT(errors.rms_when_steady, kAcceptedError);
  EXPECT_LT(std::abs(errors.mean_in_ramps), kAcrossCorners);
  EXPECT_GT(errors.known, kKnown);
}

TEST(LocalMotion, KeepsCornersOfPositions) {
  // exact, rounded to one of 65,536 counts a turn, and to one of 4096
  for (const double noise : {0.0, 9.6e-5 / std::sqrt(12), 1.5e-3 / std::sqrt(12)}) {
    const Measurements m = Moves(0, noise);
    const Errors errors = ErrorsOf(m, FollowLocally(m, {{0, m.size()}}, MotionSource::positions));
    EXPECT_LT(errors.rms_when_steady, kAcceptedError) << noise;
    EXPECT_LT(std::abs(errors.mean_in_ramps), kAcrossCorners) << noise;
    EXPECT_GT(errors.known, kKnown) << noise;
  }
}

TEST(LocalMotion, IsThePolynomialThatItFits) {
  // cubic velocities and quartic positions are followed to rounding, on uneven samples
  const Eigen::Index n = 60;
  Measurements m;
  m.time = Eigen::VectorXd::LinSpaced(n, 0, 5.9);
  for (Eigen::Index i = 0; i < n; i += 2) m.time[i] += 0.03;
  const Eigen::ArrayXd t = m.time.array();
  m.velocity = 1 + t - 0.3 * t.square() + 0.02 * t.cube();
  m.position = t + t.square() / 2 - 0.1 * t.cube() + 0.005 * t.square().square();
  m.torque = Eigen::VectorXd::Zero(n);
  const Eigen::ArrayXd acceleration = 1 - 0.6 * t + 0.06 * t.square();
  for (const MotionSource source : {MotionSource::velocity, MotionSource::positions}) {
    const LocalMotion motion = FollowLocally(m, {{0, n}}, source);
    // a window of 7 samples, and a neighbour, at each end
    EXPECT_GE(motion.known.count(), n - 8);
    for (Eigen::Index i = 0; i < n; ++i) {
      if (!motion.known[i]) continue;
      // rounding of 7 samples, over the square of a step
      EXPECT_NEAR(motion.acceleration[i], acceleration[i], 1e-11) << i;
      EXPECT_NEAR(motion.velocity[i], m.velocity[i], 1e-11) << i;
    }
  }
}

TEST(LocalMotion, KnowsNothingBeyondGaps) {
  Measurements m = Moves(0.02, 0);
  const LocalMotion motion = FollowLocally(m, {{0, 4000}, {4000, 4000}}, MotionSource::velocity);
  for (const Eigen::Index end : {0, 3999, 4000, 7999}) EXPECT_FALSE(motion.known[end]) << end;
}

}  // namespace
}  // namespace warmjoint
