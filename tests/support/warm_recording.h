// Recordings of a joint, made without any scenario: warm, slow, of any motion, with parts missing.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "models/foundation/random_stream.h"
#include "models/friction/along_motion.h"
#include "models/recording/measurements.h"
#include "tests/support/vectors.h"

namespace warmjoint::test {

/// Table I of the paper.
inline Friction TableOne() {
  return {"viscous_coulomb", {{"viscous", 5}, {"coulomb", 15}}, Thermal{-3, 600}, 0, 1};
}

/// Speeds drawn from U(0.1, 1) rad/s, held for 20 s at 1 s a sample, of alternating sign.
/// n: samples; rest: every other span of so many samples is at rest (0: none).
inline Eigen::VectorXd AlternatingSpeeds(Eigen::Index n, std::uint64_t seed,
                                         Eigen::Index rest = 0) {
  RandomStream random({seed, 0}, Stream::motion);
  Eigen::VectorXd velocity(n);
  double v = -1;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (i % 20 == 0) v = std::copysign(random.Uniform(0.1, 1), -v);
    velocity[i] = rest > 0 && i / rest % 2 == 1 ? 0.0 : v;
  }
  return velocity;
}

/// What `friction` gives along a motion, with white noise. step: s; velocity: [N] rad/s;
/// noise: standard deviation, N.m.
inline Measurements RecordFriction(const Friction& friction, double step,
                                   const Eigen::VectorXd& velocity, double noise,
                                   std::uint64_t seed) {
  Measurements m = Record(step, velocity, Eigen::VectorXd::Zero(velocity.size()));
  m.torque =
      AlongMotion(friction).Predict({m.time, m.velocity, m.position, MotorPosition(m)}).force;
  RandomStream random({seed, 0}, Stream::torque_noise);
  for (double& torque : m.torque) torque += noise * random.Normal();
  return m;
}

/// The same speeds at so many times the rate.
inline Eigen::VectorXd Finer(const Eigen::VectorXd& velocity, Eigen::Index times) {
  return velocity.transpose().replicate(times, 1).reshaped();
}

/// Adds AR(1) noise to the torque: deviation, N.m; coefficient from one sample to the next.
inline void AddNoise(Measurements& m, double deviation, double coefficient, std::uint64_t seed) {
  RandomStream random({seed, 1}, Stream::torque_noise);
  double noise = deviation * random.Normal();
  for (double& torque : m.torque) {
    torque += noise;
    noise = coefficient * noise +
            std::sqrt(1 - coefficient * coefficient) * deviation * random.Normal();
  }
}

/// The joint of Table I, cold, with the Stribeck effect below some 0.1 rad/s.
inline Friction StribeckJoint() {
  return {"stribeck",
          {{"viscous", 5},
           {"coulomb", 15},
           {"static", 20},
           {"stribeck_velocity", 0.05},
           {"stribeck_exponent", 2}},
          {}};
}

/// The same with a level of 15 N.m forwards and 12 N.m backwards.
inline Friction TwoLevelStribeckJoint() {
  return {"asymmetric_stribeck",
          {{"viscous", 5},
           {"coulomb_positive", 15},
           {"coulomb_negative", 12},
           {"static_rise", 5},
           {"stribeck_velocity", 0.05},
           {"stribeck_exponent", 2}},
          {}};
}

/// Speeds from 0.005 to 1 rad/s, even in their logarithm, held for `hold` samples, of alternating
/// sign. n: samples.
inline Eigen::VectorXd SlowAndFast(Eigen::Index n, std::uint64_t seed, Eigen::Index hold = 20) {
  RandomStream random({seed, 0}, Stream::motion);
  Eigen::VectorXd velocity(n);
  double v = -1;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (i % hold == 0) v = std::copysign(0.005 * std::pow(200, random.Uniform(0, 1)), -v);
    velocity[i] = v;
  }
  return velocity;
}

inline constexpr double kInertia = 2, kSine = 5, kCosine = 1.5, kExcitedNoise = 0.5;
inline constexpr double kExcitedStep = 0.02;

/// Three harmonics that never repeat each other, with inertia and gravity in the torque.
inline Measurements Excited(const Friction& friction, Eigen::Index n, std::uint64_t seed) {
  const Eigen::ArrayXd t =
      kExcitedStep * Eigen::ArrayXd::LinSpaced(n, 0, static_cast<double>(n - 1));
  const auto velocity =
      (0.6 * (0.7 * t).sin() + 0.5 * (1.9 * t).sin() + 0.4 * (3.1 * t).sin()).eval();
  const auto acceleration =
      (0.42 * (0.7 * t).cos() + 0.95 * (1.9 * t).cos() + 1.24 * (3.1 * t).cos()).eval();
  const auto position =
      (-0.6 / 0.7 * (0.7 * t).cos() - 0.5 / 1.9 * (1.9 * t).cos() - 0.4 / 3.1 * (3.1 * t).cos())
          .eval();
  Measurements m = RecordFriction(friction, kExcitedStep, velocity.matrix(), kExcitedNoise, seed);
  m.position = position.matrix();
  m.torque +=
      (kInertia * acceleration + kSine * position.sin() + kCosine * position.cos()).matrix();
  return m;
}

/// A time that is missing.
struct Cut {
  double from = 0, to = 0;  // s
};

/// The recording without the samples that lie inside of a cut.
inline Measurements Without(const Measurements& m, const std::vector<Cut>& cuts) {
  std::vector<Eigen::Index> left;
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    const auto inside = [t = m.time[i]](const Cut& cut) { return cut.from < t && t < cut.to; };
    if (std::none_of(cuts.begin(), cuts.end(), inside)) left.push_back(i);
  }
  Measurements some = m;
  ForEachColumn(some, [&](Eigen::VectorXd& column) { column = column(left).eval(); });
  return some;
}

}  // namespace warmjoint::test
