// Recordings of a joint that never holds a speed.
#pragma once

#include "tests/support/warm_recording.h"

namespace warmjoint::test {

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

}  // namespace warmjoint::test
